// A blind walk whose sensors fail: short faults are bridged, long ones make it sit down.
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/simulation/plant.hpp"
#include "tests/scenarios/loop.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::holds;
using test::Loop;
using test::scenario;

constexpr double kFaultTime = 2.5;     // in the walk, a foot in the air [s]
constexpr double kLimit = 40.0;        // of every joint of the robot [N·m]
constexpr double kHardLanding = 1.0;   // of the base [m/s]; a free fall gives 2.4 …
constexpr double kBlindLanding = 2.0;  // … and without encoders nothing can be led down
constexpr double kMostChange = control::SafetyOptions{}.max_torque_change;

struct Fault {
  std::string sensor, kind, more, said;

  /// A spike has no duration.
  [[nodiscard]] std::string option(double duration, double time = kFaultTime) const {
    return "sensors.faults.one={sensor: " + sensor + ", kind: " + kind +
           ", time: " + std::to_string(time) +
           (duration > 0.0 ? ", duration: " + std::to_string(duration) : "") +
           (more.empty() ? "" : ", " + more) + "}";
  }
  [[nodiscard]] bool is_of_encoders() const { return sensor == "encoders"; }
};

std::ostream& operator<<(std::ostream& out, const Fault& fault) {
  return out << fault.sensor << " " << fault.kind << " " << fault.more;
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {"imu", "stops", "", "IMU stopped"},
      {"imu", "repeats", "", "IMU stopped"},
      {"imu", "nan", "", "IMU gave no numbers"},
      {"imu", "late", "size: 10", "IMU came late"},
      {"gyro", "repeats", "", "IMU repeated"},
      {"gyro", "jump", "size: 5", "IMU changed too fast"},
      {"accelerometer", "nan", "", "IMU gave no numbers"},
      {"accelerometer", "jump", "size: 400", "IMU left the range"},
      {"encoders", "stops", "", "encoders stopped"},
      {"encoders", "repeats", "", "encoders stopped"},
      {"encoders", "nan", "", "encoders of several joints gave no numbers"},
      {"encoders", "nan", "joint: LF_KFE", "encoder LF_KFE gave no numbers"},
      {"encoders", "late", "size: 10", "encoders came late"},
      {"encoders", "jump", "size: 0.3", "encoders of several joints changed too fast"},
      {"joint_torques", "stops", "", "joint torques stopped"},
      {"joint_torques", "repeats", "", "joint torques stopped"},
      {"joint_torques", "nan", "", "joint torques of several joints gave no numbers"},
      {"joint_torques", "late", "size: 10", "joint torques came late"},
      {"joint_torques", "jump", "size: 200", "joint torques of several joints left the range"},
  };
  return all;
}

std::vector<std::string> walk(const std::string& fault, double duration) {
  return {"planner.calibration.duration=0", "duration=" + std::to_string(duration), fault};
}

/// What every tick of a run showed.
struct Course {
  double fastest_descent = 0.0;  // [m/s]
  double largest_change = 0.0;   // of a torque in a tick, at fault and until it caught up [N·m]
  CommandMode worst = CommandMode::optimal;
  double tilt_end = 0.0;
  int steps_before = 0, steps = 0;
  bool sat = false;
};

bool is_at_fault(const SensorHealth& health) {
  return health.encoders.fault != SampleFault::none ||
         health.joint_torques.fault != SampleFault::none || health.imu.fault != SampleFault::none;
}

Course follow(const Fault& fault, double fault_duration, double end,
              double fault_time = kFaultTime) {
  Loop loop(scenario("walk_flat", walk(fault.option(fault_duration, fault_time), end)));
  Course course;
  JointVector before = JointVector::Zero(kNumLegJoints);
  bool catches_up = false;
  for (double time = 0.0; time < end; time = loop.record().reading.time) {
    loop.tick();
    const TickRecord& record = loop.record();
    const JointVector& torque = record.command.torque;
    EXPECT_TRUE(torque.allFinite());
    EXPECT_LE(torque.cwiseAbs().maxCoeff(), kLimit);
    const double change = (torque - before).cwiseAbs().maxCoeff();
    const bool at_fault = is_at_fault(record.health);
    if (at_fault || catches_up) course.largest_change = std::max(course.largest_change, change);
    catches_up = at_fault || (catches_up && change >= kMostChange - 1e-9);
    before = torque;
    course.fastest_descent = std::max(course.fastest_descent, -loop.truth().v_SB.z());
    course.worst = std::max(course.worst, record.command.mode);
    course.sat = course.sat || record.command.mode == CommandMode::sit;
    if (record.reading.time < fault_time) course.steps_before = loop.steps_taken();
  }
  course.steps = loop.steps_taken();
  course.tilt_end = std::acos(loop.truth().q_SB.toRotationMatrix()(2, 2));
  return course;
}

class SensorFault : public testing::TestWithParam<Fault> {};

TEST_P(SensorFault, ForAShortTimeIsBridged) {
  for (const double time : {kFaultTime, 2.8, 3.1}) {
    for (const double duration : {0.005, 0.015}) {
      const Course course = follow(GetParam(), duration, time + 2.5, time);
      EXPECT_EQ(course.worst, CommandMode::optimal) << duration << " at " << time;
      EXPECT_GE(course.steps, course.steps_before + 3) << duration << " at " << time;
      EXPECT_LE(course.largest_change, kMostChange + 1e-9) << duration << " at " << time;
    }
  }
}

TEST_P(SensorFault, ForLongMakesItSitDownOrDropWithoutItsEncoders) {
  const Course course = follow(GetParam(), 1.0, 6.0);
  const bool is_of_one_leg = GetParam().more.find("joint") != std::string::npos;
  EXPECT_EQ(course.sat, !GetParam().is_of_encoders() || is_of_one_leg);
  EXPECT_EQ(course.worst, CommandMode::damping) << "in the end";
  EXPECT_LE(course.fastest_descent, GetParam().is_of_encoders() ? kBlindLanding : kHardLanding);
  EXPECT_LE(course.largest_change, kMostChange + 1e-9);
  EXPECT_LE(course.tilt_end, GetParam().is_of_encoders() ? 1.0 : 0.5);
  const closed_loop::RunResult result =
      closed_loop::run_closed_loop(scenario("walk_flat", walk(GetParam().option(1.0), 8.0)), {});
  EXPECT_TRUE(result.safety_stop);
  EXPECT_FALSE(result.metrics.fell) << result.metrics.reason;
  EXPECT_TRUE(holds(result.metrics.reason, "the controller stopped for safety at 2.5"));
  EXPECT_TRUE(holds(result.metrics.reason, GetParam().said));
  RecordProperty("descent", std::to_string(course.fastest_descent));
  RecordProperty("change", std::to_string(course.largest_change));
  RecordProperty("reason", result.metrics.reason);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SensorFault, testing::ValuesIn(faults()),
                         [](const auto& parameter) {
                           const Fault& fault = parameter.param;
                           return fault.sensor + "_" + fault.kind + "_" +
                                  (fault.said.find("LF_KFE") == std::string::npos ? "all" : "one");
                         });

TEST(SensorFaults, ASecondLegsEncoderThatIsLostLaterLeavesNothingToSitDownBy) {
  std::vector<std::string> options = walk(
      "sensors.faults.one={sensor: encoders, kind: nan, "
      "joint: LF_KFE, time: 2.5}",
      4.0);
  options.emplace_back(
      "sensors.faults.two={sensor: encoders, kind: nan, joint: RH_KFE, time: 2.7}");
  Loop loop(scenario("walk_flat", options));
  loop.run_until(2.65);
  EXPECT_EQ(loop.record().command.mode, CommandMode::sit);
  loop.run_until(2.75);
  EXPECT_EQ(loop.record().command.mode, CommandMode::damping);
  EXPECT_TRUE(std::isnan(loop.record().state.q[11])) << "RH_KFE";
}

/// From the first tick on nothing comes: there was never a state, nor anything to bridge with.
class DeadSensor : public testing::TestWithParam<Fault> {};

TEST_P(DeadSensor, IsNamedAndSatDownForWhereTheJointsAreKnown) {
  const std::string fault = GetParam().option(0.0, 0.0);
  Loop loop(scenario("walk_flat", walk(fault, 5.0)));
  double fastest_descent = 0.0;
  JointVector before = JointVector::Zero(kNumLegJoints);
  bool sat = false;
  loop.run_until(5.0, [&] {
    const JointCommand& command = loop.record().command;
    EXPECT_LE((command.torque - before).cwiseAbs().maxCoeff(), kMostChange + 1e-9);
    before = command.torque;
    fastest_descent = std::max(fastest_descent, -loop.truth().v_SB.z());
    sat = sat || command.mode == CommandMode::sit;
    return testing::Test::HasFailure();
  });
  EXPECT_EQ(sat, !GetParam().is_of_encoders());
  EXPECT_EQ(loop.record().command.mode, CommandMode::damping) << "in the end";
  EXPECT_LE(fastest_descent, GetParam().is_of_encoders() ? 3.0 : 0.7);
  const closed_loop::RunResult result =
      closed_loop::run_closed_loop(scenario("walk_flat", walk(fault, 2.0)), {});
  EXPECT_TRUE(result.safety_stop);
  EXPECT_TRUE(holds(result.metrics.reason, GetParam().said));
}

INSTANTIATE_TEST_SUITE_P(
    FromTheStart, DeadSensor,
    testing::Values(Fault{"imu", "nan", "", "IMU gave no numbers"},
                    Fault{"imu", "stops", "", "IMU"},
                    Fault{"gyro", "nan", "", "IMU gave no numbers"},
                    Fault{"joint_torques", "stops", "", "joint torques"},
                    Fault{"joint_torques", "nan", "joint: RF_HFE", "joint torque RF_HFE"},
                    Fault{"encoders", "nan", "", "encoders of several joints gave no numbers"},
                    Fault{"encoders", "nan", "joint: LF_KFE", "encoder LF_KFE gave no numbers"}),
    [](const auto& parameter) {
      const Fault& fault = parameter.param;
      return fault.sensor + "_" + fault.kind + (fault.more.empty() ? "_all" : "_one");
    });

/// From a moment on; the walk goes on by the joints.
class FootSensorFault : public testing::TestWithParam<Fault> {};

TEST_P(FootSensorFault, DoesNotEndTheWalk) {
  for (const double time : {kFaultTime, 2.8, 3.1}) {
    std::vector<std::string> options = walk(GetParam().option(0.0, time), 10.0);
    options.insert(options.begin(), "sensors.foot_force.present=true");
    options.emplace_back("contact_force.use_foot_sensor=true");
    Loop loop(scenario("walk_flat", options));
    loop.run_until(time);
    const int steps = loop.steps_taken();
    double largest_change = 0.0;
    JointVector before = loop.record().command.torque;
    loop.run_until(10.0, [&] {
      const JointCommand& command = loop.record().command;
      EXPECT_EQ(command.mode, CommandMode::optimal) << "at " << loop.record().reading.time;
      largest_change = std::max(largest_change, (command.torque - before).cwiseAbs().maxCoeff());
      before = command.torque;
      return testing::Test::HasFailure();
    });
    EXPECT_GE(loop.steps_taken(), steps + 5) << "at " << time;
    EXPECT_LT(largest_change, 30.0)
        << "at " << time << ", of a foot in the air that seems to touch";
    RecordProperty("change", std::to_string(largest_change));
    RecordProperty("steps", loop.steps_taken());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FootSensorFault,
                         testing::Values(Fault{"foot_force", "stops", "", ""},
                                         Fault{"foot_force", "repeats", "", ""},
                                         Fault{"foot_force", "nan", "leg: LF", ""},
                                         Fault{"foot_force", "late", "size: 20", ""},
                                         Fault{"foot_force", "jump", "size: 300", ""},
                                         Fault{"foot_force", "jump", "size: -300", ""},
                                         Fault{"foot_force", "jump", "size: 30", ""},
                                         Fault{"foot_force", "jump", "size: 12, leg: LF", ""},
                                         Fault{"foot_force", "jump", "size: 300, leg: RH", ""}),
                         [](const auto& parameter) {
                           const Fault& fault = parameter.param;
                           return fault.kind + "_" + std::to_string(parameter.index);
                         });

TEST(SensorSpike, ChangesNothingThatLasts) {
  for (const Fault& fault :
       {Fault{"gyro", "spike", "size: 8", ""}, Fault{"gyro", "spike", "size: 1", ""},
        Fault{"accelerometer", "spike", "size: 350", ""},
        Fault{"accelerometer", "spike", "size: 100", ""},
        Fault{"encoders", "spike", "size: 0.3", ""},
        Fault{"encoders", "spike", "size: 0.08, joint: RF_KFE", ""},
        Fault{"encoders", "spike", "size: 0.06", ""}, Fault{"encoders", "spike", "size: 0.01", ""},
        Fault{"joint_torques", "spike", "size: 150", ""},
        Fault{"joint_torques", "spike", "size: 60", ""}}) {
    for (const double time : {kFaultTime, 2.8, 3.1}) {
      const Course course = follow(fault, 0.0, time + 2.0, time);
      EXPECT_EQ(course.worst, CommandMode::optimal) << fault << " at " << time;
      EXPECT_GE(course.steps, course.steps_before + 2) << fault << " at " << time;
      EXPECT_GT(course.largest_change, 0.0) << fault << " at " << time << " was not found";
      EXPECT_LE(course.largest_change, kMostChange + 1e-9) << fault << " at " << time;
    }
  }
}

}  // namespace
}  // namespace surefoot
