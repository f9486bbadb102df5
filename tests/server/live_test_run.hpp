#pragma once

#include "server/live_view.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/server/read_block.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace surefoot::test {

/// A run that is steered as by a page, on one thread: what is to be done at a tick is done before
/// it.
class LiveTestRun {
 public:
  explicit LiveTestRun(const std::vector<std::string>& assignments,
                       const std::string& scenario_name = "walk_flat_ideal",
                       bool waits_for_page = false)
      : scenario(config::load_scenario({scenario_name, 0, over_many_levels(assignments)})),
        wishes(scenario, server::ViewLimits()),
        feed(scenario, wishes, ""),
        view(wishes, feed, [this] { return turn(); }, waits_for_page) {
    server::ViewCommand fast{.type = server::ViewCommandType::speed, .factor = 8.0};
    (void)wishes.command(fast);
  }

  /// Before the tick with this number.
  void at(long tick, std::function<void()> action) { actions_[tick].push_back(std::move(action)); }
  void at(long tick, const server::ViewCommand& command) {
    at(tick, [this, command] { errors.push_back(wishes.command(command)); });
  }

  /// Runs and keeps the log as `log`.
  closed_loop::RunResult record() { return run(log); }

  closed_loop::RunResult run(const std::string& record = "") {
    closed_loop::ClosedLoopOptions options;
    options.record_path = record;
    options.steering = &view;
    const closed_loop::RunResult result = closed_loop::run_closed_loop(scenario, options);
    drain();
    return result;
  }

  /// The values of a channel, one a tick.
  [[nodiscard]] std::vector<double> of(const std::string& channel, std::size_t place = 0) const {
    std::vector<double> values;
    for (const server::ViewChannel& entry : channels.channels) {
      if (entry.name != channel) continue;
      for (const server::ViewFrame& frame : frames)
        values.push_back(frame.floats.at(entry.offset + place));
    }
    return values;
  }

  config::Scenario scenario;
  server::LiveOperator wishes;
  server::LiveFeed feed;
  server::LiveView view;
  server::ViewChannels channels;
  std::vector<server::ViewFrame> frames;    // of all that the pages got
  std::vector<std::uint32_t> generations;   // of each frame
  std::vector<std::string> events;          // messages of these
  std::vector<std::string> changes;         // texts of those of them that are changes
  std::vector<std::string> messages;        // without status and events
  std::vector<std::string> errors;          // of the commands
  std::function<void()> each_turn = [] {};  // before each tick, and while the run waits
  const TemporaryFolder folder;
  const std::string log = folder / "run.mcap";

 private:
  static std::vector<std::string> over_many_levels(std::vector<std::string> assignments) {
    assignments.insert(assignments.begin(), "stack=terrain_adaptation");
    return assignments;
  }

  /// Is called before each tick, and while it waits.
  bool turn() {
    drain();
    each_turn();
    const auto next = static_cast<long>(frames.size());
    if (const auto found = actions_.find(next); found != actions_.end()) {
      const auto todo = std::exchange(found->second, {});
      for (const auto& action : todo) action();
    }
    return false;
  }

  void drain() {
    for (const server::SharedBlock& block : feed.blocks()) {
      logging::LogHeader header;
      header.level_names = names();
      if (channels.floats == 0) channels = server::tick_channels(header, truth_of(block));
      const auto head = server::packed({block.frames, 0, block.generation});
      const server::ReadBlock read =
          server::read_block(std::string(head.data(), head.size()) + *block.bytes, channels.floats);
      frames.insert(frames.end(), read.frames.begin(), read.frames.end());
      generations.insert(generations.end(), read.frames.size(), block.generation);
    }
    for (std::string& message : feed.messages(1)) {
      if (message.starts_with(R"({"type":"status")")) continue;
      const auto parsed = nlohmann::json::parse(message);
      for (const auto& event : parsed.value("events", nlohmann::json::array()))
        if (event.is_object() && event.at("kind") == "change") changes.push_back(event.at("text"));
      (parsed.contains("events") ? events : messages).push_back(std::move(message));
    }
  }

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const control::LevelSpec& level : scenario.controller.stack.levels)
      list.push_back(level.name);
    return list;
  }

  /// With MuJoCo's vectors as long as they must be for this block.
  [[nodiscard]] simulation::GroundTruth truth_of(const server::SharedBlock&) const {
    return simulation::Plant(scenario.robot, scenario.plant).truth();
  }

  std::map<long, std::vector<std::function<void()>>> actions_;
};

}  // namespace surefoot::test
