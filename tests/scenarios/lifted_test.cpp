// A robot that somebody lifts, and one that begins on its belly.
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

/// What must hold at every tick of a robot that is lifted or lies.
struct Watch {
  explicit Watch(const Loop& watched) : loop(watched) {}
  bool operator()() {
    const JointCommand& command = loop.record().command;
    const SensorHealth& health = loop.record().health;
    is_well = is_well && command.cause == StopCause::none &&
              health.imu.fault == SampleFault::none && health.encoders.fault == SampleFault::none &&
              health.joint_torques.fault == SampleFault::none;
    if (command.mode == CommandMode::lifted) lifted_for += 0.0025;
    const bool hangs = command.mode == CommandMode::lifted && lifted_for > 0.5 &&
                       std::ranges::none_of(loop.truth().feet, &simulation::TrueContact::touching);
    if (hangs) relaxed = std::max(relaxed, command.torque.cwiseAbs().maxCoeff());
    return !is_well;
  }

  const Loop& loop;
  bool is_well = true;
  double lifted_for = 0.0;  // [s]
  double relaxed = 0.0;  // largest torque half a second after it was lifted, feet in the air [N·m]
};

// In the calibration, as it stands, and in four parts of the gait.
TEST(Lifted, ItRelaxesAndWalksOnWhenItIsPutDown) {
  for (const double time : {3.0, 8.0, 13.0, 13.2, 13.4, 13.6}) {
    SCOPED_TRACE(time);
    const std::string lift =
        "disturbances.lifts.hands={height: 0.3, hold: 2, time: " + std::to_string(time) + "}";
    Loop loop(scenario("walk_flat", {lift, "randomise.include=mismatch"}, 5));
    Watch watch(loop);
    loop.run_until(time + 9.0, std::ref(watch));
    EXPECT_TRUE(watch.is_well);
    EXPECT_EQ(loop.count(PlanEvent::lifted), 1);
    EXPECT_EQ(loop.count(PlanEvent::stands_up), 1);
    EXPECT_GT(watch.lifted_for, 2.0);
    EXPECT_LT(watch.relaxed, 15.0);
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
    EXPECT_EQ(loop.record().plan.calibration, CalibrationStage::turning);
    EXPECT_GT(loop.truth().p_SB.z(), 0.44);
    EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
    const int steps = loop.steps_taken();
    loop.run_until(time + 23.0, std::ref(watch));
    EXPECT_TRUE(watch.is_well);
    EXPECT_GT(loop.steps_taken(), steps + 6);
  }
}

TEST(Lifted, PushedAsItHangsItStaysRelaxed) {
  Loop loop(scenario(
      "walk_flat",
      {"safety.damp_after_failures=5", "disturbances.lifts.hands={time: 2, height: 0.3, hold: 4}",
       "disturbances.pushes.a={time: 4, duration: 0.2, impulse: [9, 0, 0]}",
       "disturbances.pushes.b={time: 5, duration: 0.2, impulse: [0, 9, 0]}"},
      1));
  Watch watch(loop);
  loop.run_until(12.0, std::ref(watch));
  EXPECT_TRUE(watch.is_well);
  EXPECT_EQ(loop.count(PlanEvent::lifted), 1);
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
}

// Whatever else makes feet lose the ground.
TEST(Lifted, NotWhereItOnlyStumbles) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> walks{
      {"step_down", {"terrain.elements.ground.height=-0.3", "planner.swing.hip_height_min=0.17"}},
      {"push_any_direction", {"disturbances.pushes.any.magnitude=150"}},
      {"cliff", {}},
      {"slope_any", {"randomise.include=mismatch"}}};
  for (const auto& [name, changes] : walks) {
    SCOPED_TRACE(name);
    Loop loop(scenario(name, changes, 7));
    loop.run_until(30.0, [&] { return loop.truth().torso_contact; });
    EXPECT_EQ(loop.count(PlanEvent::lifted), 0);
    EXPECT_EQ(loop.count(PlanEvent::stands_up), 0);
  }
}

TEST(LyingStart, ItStandsUpCalibratesAndWalks) {
  for (const char* robots : {"", "mismatch"}) {
    SCOPED_TRACE(robots);
    std::vector<std::string> changes;
    if (*robots != '\0') changes.push_back(std::string("randomise.include=") + robots);
    Loop loop(scenario("lying_start", changes, 4));
    EXPECT_TRUE(loop.truth().torso_contact);
    Watch watch(loop);
    loop.run_until(7.0, std::ref(watch));
    EXPECT_TRUE(watch.is_well);
    EXPECT_EQ(loop.count(PlanEvent::stands_up), 1);
    EXPECT_EQ(loop.count(PlanEvent::lifted), 0);
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
    EXPECT_GT(loop.truth().p_SB.z(), 0.44);
    EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
    loop.run_until(21.0, std::ref(watch));
    EXPECT_TRUE(watch.is_well);
    EXPECT_GT(loop.steps_taken(), 6);
  }
}

// Its first ticks have no state that could be believed.
TEST(LyingStart, AnImuThatBeginsLateIsWaitedFor) {
  Loop loop(scenario("lying_start",
                     {"sensors.faults.f={sensor: imu, kind: stops, time: 0, duration: 0.05}"}, 4));
  loop.run_until(8.0, [&] { return loop.record().command.cause != StopCause::none; });
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  EXPECT_GT(loop.truth().p_SB.z(), 0.44);
}

}  // namespace
}  // namespace surefoot
