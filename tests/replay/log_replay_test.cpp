#include "surefoot/replay/log_replay.hpp"

#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/closed_loop/run_log.hpp"
#include "surefoot/closed_loop/run_steering.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/replay/log_verification.hpp"
#include "surefoot/simulation/truth_estimator.hpp"
#include "tests/logging/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::replay {
namespace {

/// Ticks of a log whose torques a controller made from it alone does not give bit for bit, and all.
std::pair<int, int> replay(const std::string& path) {
  LogReplay log(path);
  int different = 0, ticks = 0;
  for (; log.step(); ++ticks) different += log.is_same() ? 0 : 1;
  return {different, ticks};
}

void expect_replayed(const config::ScenarioRequest& request) {
  const test::TemporaryFolder folder;
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  const closed_loop::RunResult result =
      closed_loop::run_closed_loop(config::load_scenario(request), options);
  EXPECT_GT(result.metrics.steps_taken, 0);
  const auto [different, ticks] = replay(folder / "run.mcap");
  EXPECT_EQ(different, 0) << "of " << ticks;
  EXPECT_EQ(ticks, std::lround(result.metrics.duration_s / 0.0025));
}

TEST(LogReplay, a_log_alone_gives_a_controller_with_the_same_torques_bit_by_bit) {
  expect_replayed({"step_down", 3, {"duration=4", "planner.calibration.duration=0"}});
}

TEST(LogReplay, also_of_a_stack_over_another_with_gains_from_the_command_line) {
  expect_replayed({"step_down",
                   0,
                   {"duration=4", "stack=terrain_without_limits", "tasks.swing_foot.kp=700",
                    "planner.calibration.duration=0",
                    "user=[{time: 0.2, walk: true, velocity: [0.05, 0.0]}]"}});
}

const std::string kSwitches =
    "stack_switches=[{time: 0.5, remove: [torso_yaw], duration: 0.3}, "
    "{time: 1, remove: [contact_force_minimisation]}, "
    "{time: 2.2, add: [torso_yaw, contact_force_minimisation], duration: 0}]";

TEST(LogReplay, also_of_a_run_whose_scenario_switches_levels) {
  expect_replayed({"walk_flat_ideal", 0, {"duration=4", "stack=terrain_adaptation", kSwitches}});
}

TEST(LogReplay, also_of_a_run_whose_gait_changes) {
  expect_replayed({"trot",
                   2,
                   {"duration=4", "planner.calibration.duration=0", "gaits=[crawl, pace]",
                    "user=[{time: 0.2, walk: true, velocity: [0.2, 0.0]}, "
                    "{time: 2, walk: true, velocity: [0.2, 0.0], gait: pace}]"}});
}

TEST(LogReplay, also_of_a_run_whose_sensors_fail) {
  expect_replayed({"walk_flat",
                   0,
                   {"duration=4", "planner.calibration.duration=0",
                    "sensors.faults.short={sensor: encoders, kind: nan, time: 2, duration: 0.01}",
                    "sensors.faults.long={sensor: imu, kind: stops, time: 3}"}});
}

/// Runs a walk whose levels are switched from outside, and records it.
void record_switched_walk(const std::string& path) {
  const config::Scenario scenario =
      config::load_scenario({"walk_flat_ideal", 0, {"duration=4", "stack=terrain_adaptation"}});
  simulation::Plant plant(scenario.robot, scenario.plant);
  control::Controller controller(scenario.robot, scenario.controller,
                                 std::make_unique<simulation::TruthEstimator>(plant.truth()));
  controller.explain_levels(true);
  logging::Recorder recorder(path, closed_loop::log_header(scenario, controller, &plant,
                                                           model::RobotModel(scenario.robot)));
  for (int tick = 0; tick < 1000; ++tick) {
    if (tick == 301) {
      EXPECT_TRUE(controller.switch_levels({.remove = {"torso_yaw"}, .duration = 0.1 / 3.0}));
    } else if (tick == 700) {
      EXPECT_TRUE(controller.switch_levels(
          {.add = {"torso_yaw"}, .remove = {"contact_force_minimisation"}, .duration = 0.2}));
    }
    const SensorReading& reading = plant.read();
    const JointCommand& command = controller.step(reading, scenario.user(reading.time));
    recorder.record(controller.record());
    plant.write(command);
  }
  recorder.close();
}

TEST(LogReplay, also_of_a_run_whose_levels_were_switched_from_outside) {
  const test::TemporaryFolder folder;
  record_switched_walk(folder / "run.mcap");
  LogReplay log(folder / "run.mcap");
  int different = 0, begun = 0, transition = 0;
  while (log.step()) {
    const HierarchyReport &replayed = log.controller().record().hierarchy,
                          &logged = log.logged().hierarchy;
    different += log.is_same() ? 0 : 1;
    begun += logged.level_switch.begins ? 1 : 0;
    transition += logged.transition_share < 1.0 ? 1 : 0;
    EXPECT_EQ(replayed.level_switch.begins, logged.level_switch.begins);
    EXPECT_EQ(replayed.transition_share, logged.transition_share);
    ASSERT_EQ(replayed.num_blocking, logged.num_blocking);
    for (std::size_t i = 0; i < static_cast<std::size_t>(logged.num_blocking); ++i)
      EXPECT_EQ(replayed.blocking[i].cost, logged.blocking[i].cost);
  }
  EXPECT_EQ(different, 0);
  EXPECT_EQ(begun, 2);
  EXPECT_NEAR(transition, 14 + 80, 1);
}

/// Runs a walk whose controller is not called at one tick, as if it had been too late, and records
/// it.
void record_walk_without_a_call(const std::string& path) {
  const config::Scenario scenario = config::load_scenario({"walk_flat_ideal", 0, {"duration=2"}});
  simulation::Plant plant(scenario.robot, scenario.plant);
  control::Controller controller(scenario.robot, scenario.controller,
                                 std::make_unique<simulation::TruthEstimator>(plant.truth()));
  controller.explain_levels(true);
  logging::Recorder recorder(path, closed_loop::log_header(scenario, controller, &plant,
                                                           model::RobotModel(scenario.robot)));
  JointCommand command;
  for (int tick = 0; tick < 800; ++tick) {
    const SensorReading& reading = plant.read();
    if (tick != 301) {
      command = controller.step(reading, scenario.user(reading.time));
      recorder.record(controller.record());
    }
    plant.write(command);
  }
  recorder.close();
}

TEST(LogReplay, also_behind_a_tick_at_which_the_controller_was_not_called) {
  const test::TemporaryFolder folder;
  record_walk_without_a_call(folder / "run.mcap");
  const Verification result = verify_log(folder / "run.mcap");
  EXPECT_EQ(result.ticks, 799);
  EXPECT_TRUE(result.is_same() && result.is_all() && result.is_whole()) << result.problem;
  EXPECT_EQ(result.clock.count, 1u);
}

/// Commands NaN or an unknown gait for a tenth of a second each.
class InvalidCommands final : public closed_loop::RunSteering {
 public:
  void begin(const closed_loop::RunParts&) override {}
  closed_loop::RunOrder before_tick(double time) override {
    time_ = time;
    return closed_loop::RunOrder::tick;
  }
  UserCommand user(const UserCommand& planned) override {
    UserCommand given = planned;
    if (time_ > 1.0 && time_ < 1.1) given.velocity.x() = kNaN;
    if (time_ > 2.0 && time_ < 2.1) given.gait = 7;
    return given;
  }
  void after_tick(const TickRecord&, const simulation::GroundTruth&, const TickTiming&) override {}

 private:
  double time_ = 0.0;
};

TEST(LogReplay, also_of_a_run_with_invalid_commands_which_are_told_once_each) {
  const test::TemporaryFolder folder;
  InvalidCommands invalid;
  closed_loop::ClosedLoopOptions options;
  options.record_path = folder / "run.mcap";
  options.steering = &invalid;
  const closed_loop::RunResult result = closed_loop::run_closed_loop(
      config::load_scenario({"walk_flat_ideal", 0, {"duration=3"}}), options);
  EXPECT_FALSE(result.metrics.fell);
  for (const auto& [event, time] :
       {std::pair(PlanEvent::invalid_command, 1.0), std::pair(PlanEvent::unknown_gait, 2.0)}) {
    const auto told = std::ranges::find(result.events, event, &evaluation::EventCount::event);
    ASSERT_NE(told, result.events.end());
    EXPECT_EQ(told->count, 1);
    EXPECT_NEAR(told->first, time, 0.006);
  }
  const Verification verification = verify_log(folder / "run.mcap");
  EXPECT_TRUE(verification.is_same() && verification.is_whole());
  for (const MessageDifferences& topic : verification.messages)
    EXPECT_EQ(topic.ticks, 0) << topic.topic;
}

}  // namespace
}  // namespace surefoot::replay
