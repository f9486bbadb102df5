// A blind walk whose sensors lie within what they can give: found before the robot falls, and it
// sits down.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/scenarios/loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

namespace surefoot {
namespace {

using test::Loop;
using test::scenario;

constexpr double kFaultTime = 2.5;    // in the walk, a foot in the air [s]
constexpr double kHardLanding = 1.2;  // of the base [m/s]; a free fall gives 2.4
constexpr double kLimit = 40.0;       // of every joint of the robot [N·m]
constexpr double kMostChange = control::SafetyOptions{}.max_torque_change;
constexpr double kMostOfAWalk = 12.0;  // that a torque changes by in a tick; 9 as measured [N·m]
constexpr double kTooFar = 0.5;        // tilt of a robot that sat down [rad]

struct Lie {
  std::string name, fault;
  StopCause cause = StopCause::imu;
  SampleFault said = SampleFault::contradicts;
  double latest = 0.0;  // after its begin [s]
  int joint = -1;
};

std::ostream& operator<<(std::ostream& out, const Lie& lie) { return out << lie.name; }

std::vector<std::string> walk(const std::string& fault) {
  return {"planner.calibration.duration=0",
          "sensors.faults.one={" + fault + ", time: " + std::to_string(kFaultTime) + "}"};
}

const std::vector<Lie>& lies() {
  static const std::vector<Lie> all{
      {"accelerometer_1", "sensor: accelerometer, kind: jump, size: 1", StopCause::imu,
       SampleFault::contradicts, 0.3},
      {"accelerometer_20", "sensor: accelerometer, kind: jump, size: 20", StopCause::imu,
       SampleFault::contradicts, 0.05},
      {"accelerometer_30", "sensor: accelerometer, kind: jump, size: 30", StopCause::imu,
       SampleFault::jump, 0.02},
      {"accelerometer_100_for_a_moment",
       "sensor: accelerometer, kind: jump, size: 100, duration: 0.03", StopCause::imu,
       SampleFault::jump, 0.02},
      {"gyroscope_1", "sensor: gyro, kind: jump, size: 1", StopCause::imu, SampleFault::jump, 0.02},
      {"gyroscope", "sensor: gyro, kind: jump, size: 0.1", StopCause::imu, SampleFault::contradicts,
       0.5},
      {"imu_late", "sensor: imu, kind: late, size: 7", StopCause::imu, SampleFault::late, 0.05},
      {"torques", "sensor: joint_torques, kind: jump, size: -20", StopCause::joint_torques,
       SampleFault::contradicts, 0.3},
      {"torque", "sensor: joint_torques, kind: jump, size: 20, joint: LF_KFE",
       StopCause::joint_torques, SampleFault::contradicts, 0.3, 2},
      {"torque_frozen", "sensor: joint_torques, kind: repeats, joint: LF_KFE",
       StopCause::joint_torques, SampleFault::repeats, 1.0, 2},
      {"encoder_frozen", "sensor: encoders, kind: repeats, joint: LF_KFE", StopCause::encoders,
       SampleFault::repeats, 0.6, 2},
      {"encoders_late", "sensor: encoders, kind: late, size: 3", StopCause::encoders,
       SampleFault::late, 0.05},
  };
  return all;
}

class SensorLie : public testing::TestWithParam<Lie> {};

TEST_P(SensorLie, IsFoundBeforeTheRobotFallsAndItSitsDown) {
  const Lie& lie = GetParam();
  Loop loop(scenario("walk_flat", walk(lie.fault)));
  JointVector before = JointVector::Zero(kNumLegJoints);
  double found = kNaN, fastest = 0.0;
  CommandMode mode = CommandMode::optimal;
  loop.run_until(6.0, [&] {
    const JointCommand& command = loop.record().command;
    const bool is_first = std::isnan(found) && command.cause != StopCause::none;
    if (is_first) {
      found = command.time - kFaultTime;
      mode = command.mode;
    }
    const double most = std::isnan(found) ? 2.0 * kLimit : kMostChange + 1e-9;
    EXPECT_LE((command.torque - before).cwiseAbs().maxCoeff(), most);
    before = command.torque;
    fastest = std::max(fastest, -loop.truth().v_SB.z());
    return testing::Test::HasFailure();
  });
  const JointCommand& command = loop.record().command;
  EXPECT_EQ(mode, CommandMode::sit);
  EXPECT_GE(found, 0.0);
  EXPECT_LE(found, lie.latest);
  EXPECT_EQ(command.cause, lie.cause);
  EXPECT_EQ(command.fault, lie.said);
  EXPECT_EQ(command.joint, lie.joint);
  EXPECT_LE(fastest, kHardLanding);
  EXPECT_LE(std::acos(loop.truth().q_SB.toRotationMatrix()(2, 2)), kTooFar);
  RecordProperty("found", std::to_string(found));
  RecordProperty("descent", std::to_string(fastest));
}

INSTANTIATE_TEST_SUITE_P(Kinds, SensorLie, testing::ValuesIn(lies()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(SensorConsistencyInWalks, ChangesNoTorqueWhileSensorsAreHonest) {
  for (const char* name : {"walk_flat", "walk_flat_mismatch"}) {
    const std::string quick = "planner.calibration.duration=0";
    Loop with(scenario(name, {quick}, 3));
    Loop without(scenario(name, {quick, "guard.consistency.enabled=false"}, 3));
    for (int i = 0; i < 2400; ++i) {
      with.tick();
      without.tick();
      ASSERT_EQ(with.record().command.torque, without.record().command.torque) << i;
    }
    EXPECT_EQ(with.record().command.cause, StopCause::none);
    EXPECT_EQ(with.allocations(), 0U) << with.last_allocation();
  }
}

// By a velocity that rests on it, joints at rest seem to be frozen.
TEST(SensorConsistencyInWalks, AnAccelerometerThatIsFarOffIsNotTakenForFrozenEncoders) {
  Loop loop(
      scenario("step_down",
               {"randomise.include=mismatch",
                "sensors.faults.one={sensor: accelerometer, kind: jump, time: 11.195, size: 50}"},
               136));
  loop.run_until(11.3);
  EXPECT_EQ(loop.record().command.cause, StopCause::imu);
  EXPECT_EQ(loop.record().command.mode, CommandMode::sit);
}

TEST(SensorConsistencyInWalks, LiesAreFoundOnARobotThatGivesNoSampleTimesToo) {
  for (const auto& [fault, cause, latest] :
       {std::tuple("sensor: accelerometer, kind: jump, size: 20", StopCause::imu, 0.05),
        std::tuple("sensor: joint_torques, kind: jump, size: -20", StopCause::joint_torques,
                   0.3)}) {
    Loop loop(scenario("walk_flat", walk(fault)));
    loop.change_readings([](SensorReading& reading) {
      reading.encoder_time = reading.torque_time = reading.imu_time = kNaN;
    });
    loop.run_until(kFaultTime);
    ASSERT_EQ(loop.record().command.cause, StopCause::none) << "honest until then";
    loop.run_until(kFaultTime + latest);
    EXPECT_EQ(loop.record().command.mode, CommandMode::sit) << fault;
    EXPECT_EQ(loop.record().command.cause, cause);
    EXPECT_EQ(loop.record().command.fault, SampleFault::contradicts);
  }
}

TEST(SensorConsistencyInWalks, SlowSensorsAreNoFault) {
  for (const char* rate :
       {"sensors.encoders.rate_hz=200", "sensors.encoders.rate_hz=100", "sensors.imu.rate_hz=200",
        "sensors.imu.rate_hz=100", "sensors.joint_torques.rate_hz=200",
        "sensors.joint_torques.rate_hz=100"}) {
    const closed_loop::RunResult run = closed_loop::run_closed_loop(
        scenario("walk_flat", {"planner.calibration.duration=0", "duration=6", rate}, 1), {});
    EXPECT_FALSE(run.safety_stop) << rate;
    EXPECT_GE(run.metrics.steps_taken, 5) << rate;
    EXPECT_EQ(run.metrics.false_touchdowns, 0) << rate;
    EXPECT_LT(run.metrics.torque_step_max_nm, kMostOfAWalk) << rate;
  }
}

TEST(SensorConsistencyInWalks, CoarseEncodersStopNothing) {
  Loop loop(scenario("walk_flat",
                     {"planner.calibration.duration=0", "sensors.encoders.resolution=0.003"}, 1));
  loop.run_until(6.0);
  EXPECT_EQ(loop.record().command.cause, StopCause::none);
}

// Not far enough to be known as wrong; of all encoders, it looks like a base that jumps.
TEST(SensorConsistencyInWalks, OneSampleThatIsALittleOffStopsNothing) {
  for (const char* size : {"0.0015", "0.003"}) {
    for (const char* time : {"2.5", "2.8", "3.1"}) {
      const std::string spike = std::string("sensors.faults.one={sensor: encoders, kind: spike, ") +
                                "size: " + size + ", time: " + time + "}";
      Loop loop(scenario("walk_flat", {"planner.calibration.duration=0", spike}, 1));
      loop.run_until(4.5);
      EXPECT_EQ(loop.record().command.mode, CommandMode::optimal) << size << " at " << time;
      EXPECT_EQ(loop.record().command.cause, StopCause::none) << size << " at " << time;
    }
  }
}

/// A fault of some ticks that comes again every few ticks, for two seconds.
std::vector<std::string> again_and_again(const std::string& fault, int every, int ticks) {
  std::vector<std::string> changes;
  for (int i = 0; i < 800 / every; ++i) {
    changes.push_back("sensors.faults.f" + std::to_string(i) + "={sensor: " + fault +
                      ", time: " + std::to_string(2.0 + 0.0025 * every * i) +
                      ", duration: " + std::to_string(0.0025 * ticks) + "}");
  }
  return changes;
}

// Every other sample comes twice, or one of four; or two of five are a tick late: of these the
// first is the one before, and the second new.
TEST(SensorConsistencyInWalks, SamplesThatComeTwiceOrATickLateLeaveTheWalkAsItIs) {
  for (const char* sensor : {"encoders", "joint_torques", "imu"}) {
    for (const auto& [kind, every, ticks] :
         {std::tuple(", kind: repeats", 2, 1), std::tuple(", kind: repeats", 4, 1),
          std::tuple(", kind: late, size: 1", 5, 2)}) {
      const std::string fault = std::string(sensor) + kind;
      std::vector<std::string> changes = again_and_again(fault, every, ticks);
      changes.insert(changes.end(), {"planner.calibration.duration=0", "duration=5"});
      const closed_loop::RunResult run =
          closed_loop::run_closed_loop(scenario("walk_flat", changes, 2), {});
      EXPECT_FALSE(run.safety_stop) << fault << " " << every;
      EXPECT_GE(run.metrics.steps_taken, 4) << fault << " " << every;
      EXPECT_EQ(run.metrics.false_touchdowns, 0) << fault << " " << every;
      EXPECT_LT(run.metrics.torque_step_max_nm, kMostOfAWalk) << fault << " " << every;
    }
  }
}

}  // namespace
}  // namespace surefoot
