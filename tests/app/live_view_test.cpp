#include "app/live_view.hpp"

#include "app/log_frames.hpp"
#include "app/log_replay.hpp"
#include "app/log_summary.hpp"
#include "app/stack_text.hpp"
#include "app/tick_explanation.hpp"
#include "app/tick_text.hpp"
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mcap_chunks.hpp"
#include "surefoot/logging/message_decoder.hpp"
#include "surefoot/logging/recorder.hpp"
#include "tests/app/live_test_run.hpp"
#include "tests/config/messages.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace surefoot {
namespace {

using nlohmann::json;
using test::LiveTestRun;
using Type = ViewCommandType;

constexpr double kPeriod = 0.0025;

ViewCommand gain(const std::string& level, const std::string& name, double value) {
  return {.type = Type::gain, .level = level, .task = level, .name = name, .value = value};
}

/// Torques of a log, tick by tick.
std::vector<JointVector> torques(const std::string& path) {
  LogReader log(path);
  TickRecord tick;
  std::vector<JointVector> list;
  while (log.next(tick)) list.push_back(tick.command.torque);
  return list;
}

std::vector<logged::Change> changes_of(const std::string& path) {
  std::vector<logged::Change> changes;
  LogReader log(path, [&](const McapMessage& message) {
    if (message.channel->topic != "/changes") return;
    logged::Decoder::decode(message.data, changes.emplace_back());
  });
  TickRecord tick;
  while (log.next(tick)) {
  }
  return changes;
}

TEST(LiveView, a_run_that_is_only_watched_is_the_same_to_the_bit) {
  const test::TemporaryFolder folder;
  LiveTestRun watched({"duration=2"});
  watched.run(folder / "watched.mcap");
  ClosedLoopOptions options;
  options.record_path = folder / "alone.mcap";
  (void)run_closed_loop(watched.scenario, options);
  EXPECT_EQ(torques(folder / "watched.mcap"), torques(folder / "alone.mcap"));
  ASSERT_EQ(watched.frames.size(), 800u);
  for (std::size_t i = 0; i < watched.frames.size(); ++i) {
    ASSERT_EQ(watched.frames[i].tick, i);
    ASSERT_EQ(watched.frames[i].time, static_cast<double>(i) * kPeriod);
  }
}

TEST(LiveView, the_frames_say_what_the_log_says) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1.5"});
  run.run(folder / "run.mcap");
  LogReader log(folder / "run.mcap");
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
    ASSERT_EQ(static_cast<std::int32_t>(run.frames[i].active.size()), tick.hierarchy.num_active);
    for (std::size_t k = 0; k < run.frames[i].active.size(); ++k) {
      ASSERT_EQ(run.frames[i].active[k].level, tick.hierarchy.active[k].level);
      ASSERT_EQ(run.frames[i].active[k].row, tick.hierarchy.active[k].id);
    }
    ASSERT_EQ(static_cast<std::int32_t>(run.frames[i].blocking.size()),
              tick.hierarchy.num_blocking);
  }
}

TEST(LiveView, the_estimate_is_counted_from_the_first_tick) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=2", "estimation=sensors", "initial.x=3", "initial.yaw=0.7"});
  const RunResult result = run.run(folder / "run.mcap");
  const auto off = run.of("estimate.position_error"), turned = run.of("estimate.heading_error");
  ASSERT_EQ(off.size(), 800u);
  EXPECT_LT(off.front(), 1e-6);
  EXPECT_LT(std::abs(turned.front()), 1e-6);
  EXPECT_GT(std::hypot(run.of("state.p_WB")[0] - run.of("truth.p_WB")[0],
                       run.of("state.p_WB", 1)[0] - run.of("truth.p_WB", 1)[0]),
            1.0);
  EXPECT_NEAR(off.back(), result.metrics.position_drift_m, 1e-6);
  EXPECT_NEAR(std::abs(turned.back()), result.metrics.heading_drift_rad, 1e-6);
  const TickExplanation last = read_tick(folder / "run.mcap", 1.9975);
  EXPECT_NEAR(last.estimate->position_error, off.back(), 1e-6);
  LogFrames log(folder / "run.mcap", LogReader(folder / "run.mcap").header());
  ASSERT_EQ(log.channels().channels.back().name, "estimate.heading_error");
  for (const std::uint32_t tick : {0u, 400u, 799u})
    EXPECT_EQ(log.frame(tick)->floats.back(), static_cast<float>(turned[tick]));
}

TEST(LiveView, what_is_counted_from_the_start_is_not_known_where_the_first_tick_is_not) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=3", "estimation=sensors"});
  run.run(folder / "run.mcap");
  const McapChunk first = McapChunks(folder / "run.mcap").chunks().at(0);
  std::string bytes = test::contents(folder / "run.mcap");
  bytes.at(first.offset + first.size / 2) ^= '\xFF';
  test::write_file(folder / "run.mcap", bytes);
  LogFrames log(folder / "run.mcap", LogReader(folder / "run.mcap").header());
  const ViewFrame* frame = log.frame(1199);
  ASSERT_NE(frame, nullptr);
  ASSERT_EQ(log.channels().channels.back().name, "estimate.heading_error");
  EXPECT_TRUE(std::isnan(frame->floats.back()));
}

TEST(LiveView, pages_of_a_run_and_of_its_log_are_told_of_the_same_events) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=6"});
  run.run(folder / "run.mcap");
  std::vector<json> live;
  for (const std::string& message : run.events) {
    const json events = json::parse(message).at("events");
    live.insert(live.end(), events.begin(), events.end());
  }
  LogSummary summary(folder / "run.mcap", LogReader(folder / "run.mcap").header());
  while (summary.ticks() < 2400) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const json logged = json::parse(summary.events_json());
  EXPECT_EQ(json(live), logged);
  const auto has_leg = [](const json& event) {
    return event.is_array() && event.at(2).is_string();
  };
  EXPECT_GT(std::ranges::count_if(live, has_leg), 3) << "a walk lifts its feet";
}

TEST(LiveView, a_push_moves_the_robot_by_its_impulse_and_stands_in_the_log) {
  const test::TemporaryFolder folder;
  LiveTestRun still({"duration=1"}), pushed({"duration=1"});
  still.run();
  pushed.at(
      200,
      ViewCommand{
          .type = Type::push, .body = "base", .impulse = Vec3(0.0, 12.0, 0.0), .duration = 0.1});
  pushed.run(folder / "run.mcap");
  EXPECT_EQ(pushed.errors, std::vector<std::string>{""});
  const std::vector<double> before = still.of("truth.v_WCom", 1),
                            after = pushed.of("truth.v_WCom", 1);
  double fastest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    fastest = std::max(fastest, after[i] - before[i]);
    if (i < 200) {
      ASSERT_EQ(after[i], before[i]);
    }
  }
  EXPECT_GT(fastest, 0.05);
  const std::vector<logged::Change> changes = changes_of(folder / "run.mcap");
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, "push");
  EXPECT_EQ(changes[0].body, "base");
  EXPECT_NEAR(changes[0].time, 200 * kPeriod, 2 * kPeriod);
  EXPECT_NEAR(changes[0].force.y() * changes[0].duration, 12.0, 1e-9);
  EXPECT_TRUE(test::holds(pushed.messages.at(0), "push of 12 N·s at base"));
}

TEST(LiveView, a_pull_at_a_point_turns_the_robot_and_ends_when_it_is_not_renewed) {
  LiveTestRun run({"duration=6"});
  for (long tick = 100; tick < 300; tick += 10) {
    run.at(tick, ViewCommand{.type = Type::pull,
                             .body = "base",
                             .point = Vec3(0.3, 0.0, 0.0),
                             .force = Vec3(0.0, 40.0, 0.0)});
  }
  run.run();
  EXPECT_EQ(run.errors, std::vector<std::string>(20));
  double most = 0.0;
  for (const double rate : run.of("truth.w_WB_B", 2)) most = std::max(most, rate);
  EXPECT_GT(most, 0.02);
  ASSERT_EQ(run.messages.size(), 2u);
  EXPECT_TRUE(test::holds(run.messages[0], "pull at base"));
  EXPECT_TRUE(test::holds(run.messages[1], "the pull ends"));
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

TEST(LiveView, a_reset_begins_the_same_run_again) {
  LiveTestRun run({"duration=0.5"});
  run.at(
      100,
      ViewCommand{
          .type = Type::gain, .level = "com_xy", .task = "com_xy", .name = "kp", .value = 150.0});
  run.at(150, ViewCommand{.type = Type::reset});
  EXPECT_EQ(run.run().ending, Ending::reset);
  const std::size_t first = run.frames.size();
  EXPECT_EQ(run.run().ending, Ending::finished);
  EXPECT_EQ(first, 150u);
  ASSERT_EQ(run.frames.size(), first + 200);
  EXPECT_EQ(run.frames[first].tick, 0u);
  EXPECT_GT(run.generations[first], run.generations[first - 1]);
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

TEST(LiveView, a_run_whose_control_was_changed_and_undone_is_replayed_to_the_bit) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=4"});
  std::vector<std::string> order;
  for (const LevelSpec& level : run.scenario.controller.stack.levels) order.push_back(level.name);
  const auto yaw = std::ranges::find(order, "torso_yaw");
  std::iter_swap(yaw, yaw - 1);
  run.at(300, gain("com_xy", "kp", 60.0));
  run.at(310, gain("swing_foot", "kp", 300.0));
  run.at(600, ViewCommand{.type = Type::order, .levels = order});
  run.at(900, ViewCommand{.type = Type::friction, .value = 0.3});
  run.at(1200, ViewCommand{.type = Type::undo});
  run.at(1210, ViewCommand{.type = Type::undo});
  run.run(folder / "run.mcap");
  EXPECT_EQ(run.errors, std::vector<std::string>(6));

  std::vector<std::string> kinds;
  for (const logged::Change& change : changes_of(folder / "run.mcap")) kinds.push_back(change.kind);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"stack", "stack", "stack", "friction", "friction", "stack"}));
  EXPECT_TRUE(test::holds(run.messages[0], "com_xy kp "));
  EXPECT_TRUE(test::holds(run.messages[4], "undo: friction 0.3 → "));

  LogReplay replay(folder / "run.mcap");
  int different = 0, ticks = 0, going_on = 0;
  for (; replay.step(); ++ticks) {
    different += replay.is_same() ? 0 : 1;
    going_on += replay.logged().hierarchy.transition_share < 1.0 ? 1 : 0;
  }
  EXPECT_EQ(ticks, 1600);
  EXPECT_EQ(different, 0);
  EXPECT_NEAR(going_on, 4 * 120, 8);
}

TEST(LiveView, levels_keep_their_names_and_numbers_when_their_order_is_changed) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1.2"});
  std::vector<std::string> names;
  for (const LevelSpec& level : run.scenario.controller.stack.levels) names.push_back(level.name);
  std::vector<std::string> order = names;
  const auto yaw = std::ranges::find(order, "torso_yaw");
  std::iter_swap(yaw, yaw - 1);
  run.at(100, ViewCommand{.type = Type::order, .levels = order});
  run.run(folder / "run.mcap");
  std::vector<std::string> last;
  McapReader file(folder / "run.mcap");
  for (McapMessage message; file.next(message);) {
    if (message.channel->topic != "/hierarchy") continue;
    logged::Hierarchy hierarchy;
    logged::Decoder::decode(message.data, hierarchy);
    last.clear();
    for (const logged::Level& level : hierarchy.levels) last.push_back(level.name);
    for (const logged::Row& row : hierarchy.active) EXPECT_NE(row.row, "?");
  }
  EXPECT_EQ(last, order) << "as they stand above each other";
  LogReader log(folder / "run.mcap");
  TickRecord tick;
  const auto number =
      static_cast<std::size_t>(std::ranges::find(names, "torso_yaw") - names.begin());
  const std::vector<double> residual = run.of("hierarchy.level.torso_yaw.residual");
  for (std::size_t i = 0; log.next(tick); ++i) {
    ASSERT_EQ(residual[i], static_cast<float>(tick.hierarchy.levels[number].residual));
  }
}

TEST(LiveView, an_explained_tick_has_the_order_that_its_levels_had) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=0.5"});
  std::vector<std::string> order = level_names(run.scenario.controller.stack);
  std::swap(order[order.size() - 1], order[order.size() - 2]);
  run.at(100, {.type = Type::order, .levels = order});
  run.run(folder / "run.mcap");
  const auto names = [&](double time) {
    const TickExplanation tick = read_tick(folder / "run.mcap", time);
    std::vector<std::string> list;
    for (const std::int16_t level : tick.order) {
      list.push_back(tick.header.level_names.at(static_cast<std::size_t>(level)));
    }
    return list;
  };
  EXPECT_EQ(names(0.1), level_names(run.scenario.controller.stack));
  EXPECT_EQ(names(0.49), order);
  const std::string text = tick_text("x", read_tick(folder / "run.mcap", 0.49));
  EXPECT_LT(text.find(" " + order[order.size() - 2]), text.find(" " + order.back()));
}

TEST(LiveView, the_status_tells_pause_and_the_operators_walk_before_any_tick_has_it) {
  LiveTestRun run({"duration=0.05"});
  (void)run.wishes.command({.type = Type::pause});
  bool told = false;
  run.at(0, [&] {
    told = test::holds(run.feed.status(1), R"("paused":true)");
    EXPECT_TRUE(test::holds(run.feed.status(1), R"("newton_seconds_left":60)"));
    (void)run.wishes.command({.type = Type::walk, .walk = true, .yaw_rate = 0.25});
    EXPECT_TRUE(test::holds(run.feed.status(1), R"("yaw_rate":0.25)"));
    EXPECT_TRUE(test::holds(run.feed.status(1), R"("by":"operator")"));
    (void)run.wishes.command({.type = Type::resume});
  });
  run.run();
  EXPECT_TRUE(told);
}

/// The forces of a log on the robot: those that its truth has at each tick, and those that a plant
/// has which gets the log's torques and changes and nothing else.
struct ForcesOfLog {
  std::vector<std::vector<double>> logged, again;
  std::size_t other_states = 0;  // ticks at which that plant's robot is elsewhere
};

ForcesOfLog forces_of(const std::string& path, const Scenario& scenario) {
  std::vector<GroundTruth> truths;
  std::vector<logged::Change> changes;
  std::vector<JointCommand> commands;
  LogReader log(path, [&](const McapMessage& message) {
    if (message.channel->topic == "/truth")
      logged::Decoder::decode(message.data, truths.emplace_back());
    if (message.channel->topic == "/changes")
      logged::Decoder::decode(message.data, changes.emplace_back());
  });
  for (TickRecord tick; log.next(tick);) commands.push_back(tick.command);
  ForcesOfLog forces;
  Plant plant(scenario.robot, scenario.plant);
  auto next = changes.begin();
  for (std::size_t i = 0; i < std::min(truths.size(), commands.size()); ++i) {
    for (; next != changes.end() && next->time <= plant.time() + 1e-9; ++next) {
      if (next->kind == "push")
        plant.push({.body = next->body,
                    .time = next->time,
                    .duration = next->duration,
                    .force = next->force});
      if (next->kind == "pull")
        plant.pull({.body = next->body, .point = next->point, .force = next->force});
    }
    forces.logged.push_back(truths[i].xfrc_applied);
    forces.again.push_back(plant.truth().xfrc_applied);
    forces.other_states += plant.truth().qpos == truths[i].qpos ? 0 : 1;
    (void)plant.read();
    plant.write(commands[i]);
  }
  return forces;
}

double force_in(const std::vector<double>& applied) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 6 <= applied.size(); i += 6)
    sum = std::max(sum, Eigen::Map<const Vec3>(&applied[i]).norm());
  return sum;
}

ViewCommand push_of(double newton_seconds, double duration) {
  return {.type = Type::push,
          .body = "base",
          .impulse = Vec3(0.0, newton_seconds, 0.0),
          .duration = duration};
}

TEST(LiveView, a_plant_that_gets_the_logged_torques_pushes_and_pulls_goes_the_same_way_to_the_bit) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=1"});
  for (long tick = 40; tick < 240; ++tick) {
    run.at(tick, {.type = Type::pull,
                  .body = "base",
                  .point = Vec3(0.2, 0.0, 0.1),
                  .force = Vec3(0, 20 + 0.1 * double(tick), 3.0 * std::sin(0.1 * double(tick)))});
  }
  run.at(100, push_of(5.0, 0.13));
  run.at(240, {.type = Type::pull, .body = "base", .force = Vec3::Zero()});
  run.run(folder / "run.mcap");
  const ForcesOfLog forces = forces_of(folder / "run.mcap", run.scenario);
  ASSERT_EQ(forces.logged.size(), 400u);
  EXPECT_EQ(forces.logged, forces.again);
  EXPECT_EQ(forces.other_states, 0u);
  const auto changes = changes_of(folder / "run.mcap");
  EXPECT_LE(changes.size(), 15u) << "a pull is another one at most 20 times a second";
  EXPECT_TRUE(changes.back().force.isZero()) << "its end is one of them";
  double impulse = 0.0;  // of what the log says
  for (std::size_t i = 0; i + 1 < changes.size(); ++i) {
    if (changes[i].kind != "pull") continue;
    const auto until = std::find_if(changes.begin() + static_cast<long>(i) + 1, changes.end(),
                                    [](const logged::Change& one) { return one.kind == "pull"; });
    impulse += changes[i].force.norm() * (until->time - changes[i].time);
  }
  const std::string end = "the pull ends after ";
  ASSERT_TRUE(changes.back().text.starts_with(end)) << changes.back().text;
  EXPECT_NEAR(std::stod(changes.back().text.substr(end.size())), impulse, 0.01 * impulse);
  EXPECT_EQ(run.messages.size(), 3u) << "pages hear of the pull's begin and end, and of the push";
}

TEST(LiveView, pushes_that_are_pressed_while_it_is_paused_do_not_add_up_beyond_the_limits) {
  const test::TemporaryFolder folder;
  LiveTestRun run({"duration=0.6"});
  run.at(100, {.type = Type::pause});
  for (int i = 0; i < 8; ++i) run.at(100, push_of(30.0, 0.2));
  run.at(100, {.type = Type::resume});
  run.at(104, push_of(50.0, 0.2));
  run.run(folder / "run.mcap");
  double most = 0.0;
  for (const std::vector<double>& applied : forces_of(folder / "run.mcap", run.scenario).logged)
    most = std::max(most, force_in(applied));
  EXPECT_NEAR(most, 300.0, 1e-6);
  const auto changes = changes_of(folder / "run.mcap");
  EXPECT_EQ(changes.size(), 2u) << "two of 30 N·s; what is left out is no change";
  const auto left_out = std::ranges::count_if(run.messages, [](const std::string& text) {
    return text.find("is left out") != std::string::npos;
  });
  EXPECT_EQ(left_out, 7);
}

TEST(LiveView, a_pull_fades_towards_what_may_be_given_each_second) {
  LiveTestRun run({"duration=3"});
  std::string status;
  for (long tick = 40; tick < 1200; tick += 10)
    run.at(tick, {.type = Type::pull, .body = "base", .force = Vec3(0, 0, 300)});
  run.at(1190, [&] { status = run.feed.status(1); });
  run.run();
  const std::vector<double> height = run.of("truth.xfrc_applied", 6 + 2);  // of the base
  EXPECT_NEAR(*std::ranges::max_element(height), 300.0, 1e-6);
  EXPECT_NEAR(height[1195], 60.0, 1.0);
  double given = 0.0;
  for (std::size_t i = 0; i < height.size(); ++i) {
    given += kPeriod * height[i];
    const std::size_t from = i >= 400 ? i - 400 : 0;
    double second = 0.0;
    for (std::size_t k = from; k < i; ++k) second += kPeriod * height[k];
    ASSERT_LE(second, 120.0) << "what the store had and what filled it";
  }
  EXPECT_GT(given, 180.0);
  EXPECT_TRUE(test::holds(status, R"("pull_is_weaker":true)")) << status;
  EXPECT_TRUE(test::holds(status, R"("push":null)"));
}

TEST(LiveView, torques_do_not_jump_when_a_gain_does) {
  const auto largest_step = [](bool change) {
    LiveTestRun run({"duration=3"});
    if (change) run.at(800, gain("torso_height", "kp", 5.0));
    run.run();
    double largest = 0.0;
    for (std::size_t joint = 0; joint < kNumJoints; ++joint) {
      const std::vector<double> torque = run.of("command.torque", joint);
      for (std::size_t i = 795; i < 830; ++i) {
        largest = std::max(largest, std::abs(torque[i + 1] - torque[i]));
      }
    }
    return largest;
  };
  EXPECT_LT(largest_step(true), largest_step(false) + 0.5);
}

}  // namespace
}  // namespace surefoot
