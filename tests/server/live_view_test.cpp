#include "server/live_view.hpp"

#include "server/log_frames.hpp"
#include "server/log_summary.hpp"
#include "surefoot/explain/tick_explanation.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/solver/solution.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/server/live_test_run.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace surefoot::server {
namespace {

using nlohmann::json;
using test::LiveTestRun;
using Type = ViewCommandType;

constexpr double kPeriod = 0.0025;

/// Torques of a log, tick by tick.
std::vector<JointVector> torques(const std::string& path) {
  logging::LogReader log(path);
  TickRecord tick;
  std::vector<JointVector> list;
  while (log.next(tick)) list.push_back(tick.command.torque);
  return list;
}

TEST(LiveView, a_run_that_is_only_watched_is_the_same_to_the_bit) {
  const test::TemporaryFolder folder;
  LiveTestRun watched({"duration=2"});
  watched.run(folder / "watched.mcap");
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "alone.mcap";
  (void)closed_loop::run_closed_loop(watched.scenario, options);
  EXPECT_EQ(torques(folder / "watched.mcap"), torques(folder / "alone.mcap"));
  ASSERT_EQ(watched.frames.size(), 800u);
  for (std::size_t i = 0; i < watched.frames.size(); ++i) {
    ASSERT_EQ(watched.frames[i].tick, i);
    ASSERT_EQ(watched.frames[i].time, static_cast<double>(i) * kPeriod);
  }
}

TEST(LiveView, a_run_that_waits_calibrates_without_a_pace_and_walks_once_a_page_has_drawn) {
  LiveTestRun run({"duration=5", "planner.calibration.duration=1.3"}, "walk_flat_ideal", true);
  run.at(0, {.type = Type::speed, .factor = 0.03125});
  std::size_t before = 0;
  int turns = 0;
  double held_at = 0.0;
  std::vector<std::pair<double, json>> calibrating;
  run.each_turn = [&] {
    if (run.frames.empty()) return;
    const json status = json::parse(run.feed.status(1));
    calibrating.emplace_back(status.at("time").get<double>(), status.at("calibrating"));
    turns = run.frames.size() == before ? turns + 1 : 0;
    before = run.frames.size();
    if (turns < 20 || held_at > 0.0) return;
    held_at = run.frames.back().time;
    EXPECT_EQ(run.wishes.command({.type = Type::speed, .factor = 8.0}), "");
    run.feed.drawn();
  };
  (void)run.run();
  EXPECT_NEAR(held_at, 4.8, 0.01);
  EXPECT_EQ(run.frames.size(), 2000u) << "no tick is lost";
  for (const auto& [time, left] : calibrating) {
    if (std::abs(time - 4.8) < 0.01) continue;
    ASSERT_EQ(left.is_null(), time > 4.8) << time;
    if (!left.is_null()) {
      EXPECT_NEAR(left.get<double>(), 4.8 - time, 1e-6);
    }
  }
}

TEST(LiveView, first_ticks_without_a_state_do_not_end_the_hurry_through_the_calibration) {
  LiveTestRun run({"duration=5.5", "planner.calibration.duration=1.3", "estimation=sensors",
                   "sensors.faults.a.sensor=encoders", "sensors.faults.a.kind=nan",
                   "sensors.faults.a.time=0", "sensors.faults.a.duration=0.02"},
                  "walk_flat_ideal", true);
  run.at(0, {.type = Type::speed, .factor = 0.03125});
  std::size_t before = 0;
  int turns = 0;
  double held_at = 0.0;
  run.each_turn = [&] {
    if (run.frames.empty() || held_at > 0.0) return;
    turns = run.frames.size() == before ? turns + 1 : 0;
    before = run.frames.size();
    if (turns < 20) return;
    held_at = run.frames.back().time;
    EXPECT_EQ(run.wishes.command({.type = Type::speed, .factor = 8.0}), "");
    run.feed.drawn();
  };
  (void)run.run();
  EXPECT_EQ(run.of("hierarchy.status").front(),
            static_cast<int>(solver::SolveStatus::invalid_input));
  EXPECT_NEAR(held_at, 5.0, 0.02);
}

TEST(LiveView, the_frames_say_what_the_log_says) {
  LiveTestRun run({"duration=1.5"});
  run.record();
  logging::LogReader log(run.log);
  TickRecord tick;
  const std::vector<double> x = run.of("plan.com.p"), foot = run.of("plan.feet.LH.p_WF", 2),
                            mode = run.of("command.mode"),
                            residual = run.of("hierarchy.level.com_xy.residual"),
                            knee = run.of("command.torque", 5);
  const auto& names = log.header().level_names;
  const auto com = static_cast<std::size_t>(std::ranges::find(names, "com_xy") - names.begin());
  for (std::size_t i = 0; log.next(tick); ++i) {
    ASSERT_EQ(x[i], static_cast<float>(tick.plan.com.p.x()));
    ASSERT_EQ(foot[i], static_cast<float>(tick.plan.feet[2].p_WF.z()));
    ASSERT_EQ(mode[i], static_cast<int>(tick.command.mode));
    ASSERT_EQ(residual[i], static_cast<float>(tick.hierarchy.levels[com].residual));
    ASSERT_EQ(knee[i], static_cast<float>(tick.command.torque[5]));
    const std::vector<FrameActive>& rows = run.frames[i].active;
    const auto num_active = static_cast<std::size_t>(tick.hierarchy.num_active);
    ASSERT_EQ(rows.size(), num_active + static_cast<std::size_t>(tick.hierarchy.num_missed));
    for (std::size_t k = 0; k < num_active; ++k) {
      const ActiveRow& row = tick.hierarchy.active[k];
      ASSERT_EQ(rows[k].level, row.level);
      ASSERT_EQ(rows[k].row, row.id);
      ASSERT_EQ(rows[k].by, static_cast<float>(row.by));
    }
    for (std::size_t k = num_active; k < rows.size(); ++k) {
      const MissedEquality& row = tick.hierarchy.missed[k - num_active];
      ASSERT_EQ(rows[k].state, kMissedEquality);
      ASSERT_EQ(rows[k].level, row.level);
      ASSERT_EQ(rows[k].row, row.id);
      ASSERT_EQ(rows[k].by, static_cast<float>(row.by));
    }
    ASSERT_EQ(static_cast<std::int32_t>(run.frames[i].blocking.size()),
              tick.hierarchy.num_blocking);
  }
}

TEST(LiveView, the_estimate_is_counted_from_the_first_tick) {
  LiveTestRun run({"duration=2", "estimation=sensors", "initial.x=3", "initial.yaw=0.7"});
  const closed_loop::RunResult result = run.record();
  const auto off = run.of("estimate.position_error"), turned = run.of("estimate.heading_error");
  ASSERT_EQ(off.size(), 800u);
  EXPECT_LT(off.front(), 1e-6);
  EXPECT_LT(std::abs(turned.front()), 1e-6);
  EXPECT_GT(std::hypot(run.of("state.p_WB")[0] - run.of("truth.p_SB")[0],
                       run.of("state.p_WB", 1)[0] - run.of("truth.p_SB", 1)[0]),
            1.0);
  EXPECT_NEAR(off.back(), result.metrics.position_drift_m, 1e-6);
  EXPECT_NEAR(std::abs(turned.back()), result.metrics.heading_drift_rad, 1e-6);
  const explain::TickExplanation last = explain::read_tick(run.log, 1.9975);
  EXPECT_NEAR(last.estimate->position_error, off.back(), 1e-6);
  LogFrames log(run.log, logging::LogReader(run.log).header());
  ASSERT_EQ(log.channels().channels.back().name, "estimate.heading_error");
  for (const std::uint32_t tick : {0u, 400u, 799u})
    EXPECT_EQ(log.frame(tick)->floats.back(), static_cast<float>(turned[tick]));
}

TEST(LiveView, plan_and_truth_are_aligned_as_in_the_log) {
  LiveTestRun run({"duration=2", "estimation=sensors", "initial.x=3", "initial.yaw=0.7"});
  run.record();
  LogFrames log(run.log, logging::LogReader(run.log).header());
  const std::vector<ViewChannel>& channels = log.channels().channels;
  for (const std::string name :
       {"alignment.com_error", "alignment.feet.p_WS", "alignment.base_error"}) {
    const auto channel = std::ranges::find(channels, name, &ViewChannel::name);
    ASSERT_NE(channel, channels.end());
    const auto live = run.of(name);
    for (const std::uint32_t tick : {0u, 400u, 799u}) {
      EXPECT_LT(std::abs(live[tick]), name == "alignment.feet.p_WS" ? 10.0 : 0.03);
      EXPECT_EQ(log.frame(tick)->floats[channel->offset], static_cast<float>(live[tick])) << name;
    }
  }
}

TEST(LiveView, what_is_counted_from_the_start_is_not_known_where_the_first_tick_is_not) {
  LiveTestRun run({"duration=3", "estimation=sensors"});
  run.record();
  const logging::McapChunk first = logging::McapChunks(run.log).chunks().at(0);
  std::string bytes = test::contents(run.log);
  bytes.at(first.offset + first.size / 2) ^= '\xFF';
  test::write_file(run.log, bytes);
  LogFrames log(run.log, logging::LogReader(run.log).header());
  const ViewFrame* frame = log.frame(1199);
  ASSERT_NE(frame, nullptr);
  ASSERT_EQ(log.channels().channels.back().name, "estimate.heading_error");
  EXPECT_TRUE(std::isnan(frame->floats.back()));
}

TEST(LiveView, pages_of_a_run_and_of_its_log_are_told_of_the_same_events) {
  LiveTestRun run({"duration=6"});
  run.record();
  std::vector<json> live;
  for (const std::string& message : run.events) {
    const json events = json::parse(message).at("events");
    live.insert(live.end(), events.begin(), events.end());
  }
  LogSummary summary(run.log, logging::LogReader(run.log).header());
  while (summary.end_tick() < 2400) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const json logged = json::parse(summary.events_json());
  EXPECT_EQ(json(live), logged);
  const auto has_leg = [](const json& event) {
    return event.is_array() && event.at(2).is_string();
  };
  EXPECT_GT(std::ranges::count_if(live, has_leg), 3) << "a walk lifts its feet";
}

TEST(LiveView, a_page_that_comes_late_can_ask_for_what_was_before) {
  LiveTestRun run({"duration=4"});
  run.at(300, {.type = Type::friction, .value = 0.3});
  run.run();
  std::size_t welcome = 0;
  for (const SharedBlock& block : run.feed.welcome()) welcome += block.frames;
  ASSERT_LT(welcome, 1000u) << "little comes unasked";
  const json session = json::parse(run.feed.get("/api/session", {}).body);
  EXPECT_EQ(session.at("first_tick"), 0);
  EXPECT_EQ(session.at("ticks"), 1600);
  const WebAnswer answer =
      run.feed.get("/api/frames", {{"from", "250"}, {"count", "100"}, {"stride", "3"}});
  ASSERT_EQ(answer.status, 200);
  const ReadBlock block = read_block(answer.body, run.channels.floats);
  ASSERT_EQ(block.frames.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    const ViewFrame& sent = run.frames.at(250 + 3 * i);
    ASSERT_EQ(block.frames[i].tick, sent.tick);
    ASSERT_EQ(block.frames[i].time, sent.time);
    ASSERT_TRUE(std::ranges::equal(block.frames[i].floats, sent.floats, [](float a, float b) {
      return a == b || (std::isnan(a) && std::isnan(b));
    }));
  }
  json told = json::array();
  for (const std::string& message : run.events) {
    const json events = json::parse(message).at("events");
    told.insert(told.end(), events.begin(), events.end());
  }
  EXPECT_EQ(json::parse(run.feed.get("/api/events", {}).body), told);
  ASSERT_EQ(run.changes.size(), 1u);
  EXPECT_TRUE(test::holds(run.changes[0], "→ 0.3"));
  EXPECT_EQ(json::parse(run.feed.status(1)).at("changes"), 1);
  EXPECT_EQ(run.feed.get("/api/frames", {{"count", "0"}}).status, 400);
}

TEST(LiveView, while_it_is_paused_it_makes_the_ticks_that_it_is_told_to) {
  LiveTestRun run({"duration=0.5"});
  run.at(20, ViewCommand{.type = Type::pause});
  std::vector<long> seen;
  int asked = 0;
  std::function<void()> wait = [&] {
    seen.push_back(static_cast<long>(run.frames.size()));
    if (++asked < 5) return run.at(20, wait);
    (void)run.wishes.command({.type = Type::step, .ticks = 7});
  };
  run.at(20, wait);
  run.at(27, ViewCommand{.type = Type::resume});
  run.run();
  EXPECT_EQ(seen, std::vector<long>(5, 20));
  EXPECT_EQ(run.frames.size(), 200u);
}

TEST(LiveView, a_paused_run_that_begins_again_makes_its_first_tick) {
  LiveTestRun run({"duration=0.5"});
  run.at(20, ViewCommand{.type = Type::pause});
  run.at(20, ViewCommand{.type = Type::reset});
  EXPECT_EQ(run.run().ending, closed_loop::Ending::reset);
  const std::size_t before = run.frames.size();
  int turns = 0;
  run.each_turn = [&] {
    if (run.frames.size() == before + 1 && ++turns == 3)
      (void)run.wishes.command({.type = Type::resume});
  };
  EXPECT_EQ(run.run().ending, closed_loop::Ending::finished);
  EXPECT_EQ(turns, 3) << "and then waits";
}

TEST(LiveView, a_reset_begins_the_same_run_again) {
  LiveTestRun run({"duration=0.5"});
  run.at(
      100,
      ViewCommand{
          .type = Type::gain, .level = "com_xy", .task = "com_xy", .name = "kp", .value = 150.0});
  run.at(150, ViewCommand{.type = Type::reset});
  EXPECT_EQ(run.run().ending, closed_loop::Ending::reset);
  const std::size_t first = run.frames.size();
  const json before = json::parse(run.feed.get("/api/session", {}).body);
  EXPECT_EQ(before.at("begun"), 0);
  EXPECT_FALSE(run.feed.welcome().empty());
  EXPECT_EQ(run.run().ending, closed_loop::Ending::finished);
  EXPECT_EQ(first, 150u);
  ASSERT_EQ(run.frames.size(), first + 200);
  EXPECT_EQ(run.frames[first].tick, 0u);
  EXPECT_GT(run.generations[first], run.generations[first - 1]);
  const json session = json::parse(run.feed.get("/api/session", {}).body);
  EXPECT_EQ(session.at("begun"), session.at("generation"));
  for (std::size_t i = 0; i < 100; ++i) {
    ASSERT_EQ(run.of("command.torque", 4)[i], run.of("command.torque", 4)[first + i]) << i;
  }
}

TEST(LiveView, the_operators_command_takes_the_place_of_the_scenarios_until_it_is_given_back) {
  LiveTestRun run({"duration=0.5", "user=[{time: 0, walk: false}]"});
  run.at(50, ViewCommand{.type = Type::walk,
                         .walk = true,
                         .velocity = Vec2(0.05, 0.01),
                         .yaw_rate = 0.1,
                         .height = -0.02});
  run.at(100, ViewCommand{.type = Type::walk, .by_scenario = true});
  run.run();
  const std::vector<double> walk = run.of("user.walk"), v = run.of("user.velocity", 1);
  EXPECT_EQ(walk[40], 0.0);
  EXPECT_EQ(walk[60], 1.0);
  EXPECT_EQ(v[60], static_cast<float>(0.01));
  EXPECT_EQ(walk[110], 0.0);
}

TEST(LiveView, the_status_tells_pause_and_the_operators_walk_before_any_tick_has_it) {
  LiveTestRun run({"duration=0.05"});
  (void)run.wishes.command({.type = Type::pause});
  bool told = false;
  run.at(0, [&] {
    told = test::holds(run.feed.status(1), R"("paused":true)");
    (void)run.wishes.command({.type = Type::walk, .walk = true, .yaw_rate = 0.25});
    EXPECT_TRUE(test::holds(run.feed.status(1), R"("yaw_rate":0.25)"));
    EXPECT_TRUE(test::holds(run.feed.status(1), R"("by":"operator")"));
    (void)run.wishes.command({.type = Type::resume});
  });
  run.run();
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace surefoot::server
