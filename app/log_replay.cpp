#include "app/log_replay.hpp"

#include "app/scratch_folder.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

/// Gives the states that it is handed, whatever the readings.
class PlaybackEstimator final : public StateEstimator {
 public:
  explicit PlaybackEstimator(const RobotState& state) : state_(state) {}
  const RobotState& update(const SensorReading&, const TickContext&) noexcept override {
    return state_;
  }

 private:
  const RobotState& state_;
};

void check_attachments(const std::string& path, const LogReader& log) {
  for (const char* name : {"resolved_stack.yaml", "robot.yaml", "robot.urdf"}) {
    if (log.header().attachment(name) != nullptr) continue;
    throw FileError(path + ": the log has no attachment " + name +
                    ", so its controller can't be made again; record the run anew" +
                    (log.problem().empty() ? "" : "; " + log.problem()));
  }
}

/// Of those that were checked.
const std::string& attachment(const LogHeader& header, const std::string& name) {
  return *header.attachment(name);
}

/// The robot's file, with its URDF where this program finds it.
std::string robot_file(const LogHeader& header, const ScratchFolder& folder) {
  std::string robot = attachment(header, "robot.yaml");
  const std::size_t urdf = robot.find("\nurdf:") + 1;
  robot.replace(urdf, robot.find('\n', urdf) - urdf,
                "urdf: " + folder.write("robot.urdf", attachment(header, "robot.urdf")));
  return folder.write("robot.yaml", robot);
}

/// The scenario as a log has it: what was set, its stack, its robot and the robot's URDF, which is
/// read again when a controller is made.
Scenario scenario_of(const LogHeader& header, const ScratchFolder& folder) {
  // JSON is YAML, so the options are a scenario file.
  return load_scenario(
      {folder.write("scenario.yaml", header.options),
       0,
       {"stack=" + folder.write("stack.yaml", attachment(header, "resolved_stack.yaml")),
        "robot=" + robot_file(header, folder)}});
}

/// The same with another stack. What the log's scenario sets of tasks must be in that one, too.
Scenario scenario_with(const std::string& stack, const LogHeader& header,
                       const ScratchFolder& folder) {
  const fs::path file = fs::absolute(find_data_file("stacks", stack));
  const std::string robot = robot_file(header, folder);
  const std::string scenario = folder.write("scenario.yaml", header.options);
  try {
    return load_scenario(
        {scenario, 0, {"stack=" + file.string(), "robot=" + robot, "stack_switches=[]"}});
  } catch (const Error& error) {
    std::string text = error.what();
    const std::size_t found = text.find(scenario);
    if (found != std::string::npos) text.replace(found, scenario.size(), "the log's scenario");
    throw Error("stack " + stack + ": " + text);
  }
}

/// What was changed stands in the log before the first tick that has it.
void keep_change(const McapMessage& message, std::vector<logged::Change>& changes) {
  if (message.channel->topic != "/changes") return;
  logged::Decoder::decode(message.data, changes.emplace_back());
}

}  // namespace

LogReplay::LogReplay(const std::string& path, const ReplayOptions& options)
    : log_(path,
           [this](const McapMessage& message) {
             keep_change(message, changes_);
             see_truth(message);
           }),
      own_stack_(options.stack.empty()) {
  check_attachments(path, log_);
  const ScratchFolder folder;
  Scenario scenario = own_stack_ ? scenario_of(log_.header(), folder)
                                 : scenario_with(options.stack, log_.header(), folder);
  estimates_ =
      options.state == ReplayedState::estimated && scenario.estimation == Estimation::sensors;
  std::unique_ptr<StateEstimator> estimator;
  if (estimates_) {
    estimator = std::make_unique<LegInertialEstimator>(scenario.robot, scenario.estimator,
                                                       scenario.controller.period);
  } else {
    estimator = std::make_unique<PlaybackEstimator>(tick_.state);
  }
  controller_ =
      std::make_unique<Controller>(scenario.robot, scenario.controller, std::move(estimator));
  explain_levels(true);
  stack_ = std::move(scenario.controller.stack);
}

bool LogReplay::step() {
  if (gap_ || !log_.next(tick_)) return false;
  if (!log_.follows()) {
    pass_over_rest();
    return false;
  }
  last_time_ = tick_.reading.time;
  apply_changes();
  switch_levels(tick_.hierarchy.level_switch);
  controller_->step(tick_.reading, tick_.user);
  return true;
}

void LogReplay::see_truth(const McapMessage& message) {
  if (own_stack_ || message.channel->topic != "/truth") return;
  GroundTruth truth;
  logged::Decoder::decode(message.data, truth);
  if (!torso_down_ && was_torso_up_ && truth.torso_contact) torso_down_ = truth.time;
  was_torso_up_ = !truth.torso_contact;
  if (std::ranges::any_of(truth.feet, &TrueContact::touching))
    feet_up_.reset();
  else if (!feet_up_)
    feet_up_ = truth.time;
}

void LogReplay::pass_over_rest() {
  gap_ = {.from = last_time_, .to = tick_.reading.time};
  do {
    ++gap_->ticks_behind;
    changes_.clear();
  } while (log_.next(tick_));
}

// As it was done to the controller at the run.
void LogReplay::apply_changes() {
  for (const logged::Change& change : changes_) {
    if (change.kind == "friction") controller_->set_friction(change.friction);
    if (change.kind != "stack" || !own_stack_) continue;
    const StackOptions stack = parse_stack(change.stack, "/changes");
    // Refused only where the program is another one; then `is_same` says so.
    (void)controller_->set_stack(stack, change.duration);
  }
  changes_.clear();
}

void LogReplay::switch_levels(const LevelSwitchReport& logged) {
  if (!logged.begins || !own_stack_) return;
  LevelSwitch change{.duration = logged.duration};
  const std::vector<std::string>& names = log_.header().level_names;
  for (std::size_t k = 0; k < std::min(names.size(), logged.change.size()); ++k) {
    if (logged.change[k] == LevelChange::comes) change.add.push_back(names[k]);
    if (logged.change[k] == LevelChange::goes) change.remove.push_back(names[k]);
  }
  // Refused only where the program is another one; then `is_same` says so.
  (void)controller_->switch_levels(change);
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool LogReplay::is_same() const {
  const JointCommand& command = controller_->record().command;
  return command.mode == tick_.command.mode &&
         std::equal(command.torque.begin(), command.torque.end(), tick_.command.torque.begin(),
                    same_bits);
}

}  // namespace surefoot
