// What a stop is told to be because of: of a robot that is shaken, no sensor that is well; of one
// whose IMU is mounted or scaled wrongly, the IMU.
#include "surefoot/config/scenario_file.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

TEST(Diagnosis, ARobotThatIsPushedOverAtAnEdgeIsStoppedForNoSensor) {
  Loop loop(scenario("step_down",
                     {"disturbances.pushes.k.time=15.2", "disturbances.pushes.k.duration=0.2",
                      "disturbances.pushes.k.impulse=[0,15,0]"},
                     3));
  loop.run_until(17.0, [&] { return loop.record().command.cause != StopCause::none; });
  EXPECT_GT(loop.truth().time, 15.2);
  EXPECT_EQ(loop.record().command.cause, StopCause::tilt);
}

// A shank comes down hard on the edge, which stops the torso's turn within two ticks.
TEST(Diagnosis, ABlowThatTheRobotGivesItselfStopsNothing) {
  const std::vector<std::string> changes{"planner.calibration.duration=0"};
  const config::Scenario walk = scenario("step_down", changes, 2);
  control::StackOptions soft = walk.controller.stack;
  const auto named = [&](const char* name) {
    return std::ranges::find(soft.levels, name, &control::LevelSpec::name);
  };
  std::iter_swap(named("torso_height"), named("torso_height") - 1);
  const config::Scenario softer = scenario("step_down", {changes[0], "tasks.com_xy.kp=123"}, 2);
  *named("com_xy") =
      *std::ranges::find(softer.controller.stack.levels, "com_xy", &control::LevelSpec::name);
  Loop loop(walk);
  loop.run_until(5.2);
  ASSERT_TRUE(loop.controller().set_stack(soft, 0.3));
  loop.run_until(11.0, [&] { return loop.record().command.cause != StopCause::none; });
  EXPECT_EQ(loop.record().command.cause, StopCause::none) << loop.truth().time;
}

struct WrongImu {
  std::string name, change;
};

class ImuFromTheStart : public testing::TestWithParam<WrongImu> {};

TEST_P(ImuFromTheStart, IsNamedAndTheRobotSitsDown) {
  Loop loop(scenario("walk_flat", {GetParam().change}, 1));
  double fastest = 0.0;
  bool sat = false;
  loop.run_until(4.0, [&] {
    fastest = std::max(fastest, -loop.truth().v_SB.z());
    sat = sat || loop.record().command.mode == CommandMode::sit;
    return false;
  });
  EXPECT_TRUE(sat);
  EXPECT_EQ(loop.record().command.cause, StopCause::imu);
  EXPECT_EQ(loop.record().command.fault, SampleFault::contradicts);
  EXPECT_LT(fastest, 0.6) << "a free fall gives 2.4 m/s";
  EXPECT_LT(std::acos(loop.truth().q_SB.toRotationMatrix()(2, 2)), 0.2);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, ImuFromTheStart,
    testing::Values(
        WrongImu{"upside_down", "sensors.imu.tilt=[3.1416, 0, 0]"},
        WrongImu{"on_its_side", "sensors.imu.tilt=[1.5708, 0, 0]"},
        WrongImu{"askew", "sensors.imu.tilt=[0.8, 0, 0]"},
        WrongImu{"wrong_sign",
                 "sensors.faults.f={sensor: accelerometer, kind: scaled, size: -1, time: 0}"},
        WrongImu{"in_g",
                 "sensors.faults.f={sensor: accelerometer, kind: scaled, size: 0.102, time: 0}"},
        WrongImu{"degrees", "sensors.faults.f={sensor: gyro, kind: scaled, size: 57.3, time: 0}"},
        WrongImu{"turns_the_other_way",
                 "sensors.faults.f={sensor: gyro, kind: scaled, size: -1, time: 0}"}),
    [](const auto& parameter) { return parameter.param.name; });

// By them the ground pulls at the feet.
TEST(Diagnosis, JointTorquesOfTheWrongSignAreNamedAndNotTheImu) {
  Loop loop(scenario("walk_flat",
                     {"sensors.faults.f={sensor: joint_torques, kind: scaled, size: -1, time: 0}"},
                     1));
  loop.run_until(1.0, [&] { return loop.record().command.cause != StopCause::none; });
  EXPECT_EQ(loop.record().command.cause, StopCause::joint_torques);
}

}  // namespace
}  // namespace surefoot
