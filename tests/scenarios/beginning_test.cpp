// What a robot begins with: sensors that come late, and first readings that are wrong.
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

/// What a beginning must not do.
struct Beginning {
  double largest_change = 0.0;  // of a torque in a tick [N·m]
  double tilt_error = 0.0;      // in the end [rad]
};

Beginning begin(Loop& loop) {
  Beginning result;
  JointVector before = loop.record().command.torque;
  loop.run_until(2.0, [&] {
    const JointVector& torque = loop.record().command.torque;
    const double change = (torque - before).cwiseAbs().maxCoeff();
    result.largest_change = std::max(result.largest_change, change);
    before = torque;
    return testing::Test::HasFailure();
  });
  const Quat off = loop.record().state.q_WB.conjugate() * loop.truth().q_SB;
  result.tilt_error = std::acos(off.toRotationMatrix()(2, 2));
  return result;
}

// Without encoders a robot has no torques: it falls until they come, is held, and begins. Where all
// knees point the same way, it sways forward on its legs meanwhile.
TEST(Beginning, SensorsMayComeLate) {
  for (const char* name : {"walk_flat", "step_down"}) {
    for (const char* sensor : {"encoders", "imu", "encoders, joint: LF_KFE"}) {
      for (const char* duration : {"0.02", "0.05", "0.1"}) {
        const std::string late = std::string("sensors.faults.late={sensor: ") + sensor +
                                 ", kind: stops, time: 0, duration: " + duration + "}";
        SCOPED_TRACE(std::string(name) + " " + sensor + " " + duration);
        Loop loop(scenario(name, {late}, 3));
        const Beginning beginning = begin(loop);
        EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
        EXPECT_LT(beginning.largest_change, control::SafetyOptions{}.max_torque_change + 1e-9);
        EXPECT_LT(beginning.tilt_error, 0.03);
      }
    }
  }
}

/// What is wrong at the first ticks.
struct WrongStart {
  std::string what;
  std::vector<std::string> faults;
  bool begins_anew = true;
};

// Whatever was begun with what is contradicted is forgotten.
TEST(Beginning, FirstReadingsMayBeWrong) {
  for (const WrongStart& wrong : std::vector<WrongStart>{
           {"encoders", {"{sensor: encoders, kind: spike, time: 0, size: 0.1}"}},
           {"encoders, far off", {"{sensor: encoders, kind: spike, time: 0, size: 0.5}"}},
           {"encoders for 20 ms",
            {"{sensor: encoders, kind: jump, time: 0, duration: 0.02, size: 0.1}"}},
           {"encoders at the second", {"{sensor: encoders, kind: spike, time: 0.0025, size: 0.1}"}},
           {"an encoder", {"{sensor: encoders, kind: spike, time: 0, size: 0.1, joint: LF_KFE}"}},
           {"gyroscope", {"{sensor: gyro, kind: spike, time: 0, size: 0.1}"}},
           {"accelerometer, as long",
            {"{sensor: accelerometer, kind: spike, time: 0, size: -6.54}"}},
           {"encoders late and silent again",
            {"{sensor: encoders, kind: stops, time: 0, duration: 0.02}",
             "{sensor: encoders, kind: stops, time: 0.16, duration: 0.015}"},
            false},
           {"a gap and a wrong sample behind it",
            {"{sensor: encoders, kind: stops, time: 0.04, duration: 0.005}",
             "{sensor: encoders, kind: spike, time: 0.045, size: 0.1}"}},
           {"encoders when 50 ms were right",
            {"{sensor: encoders, kind: spike, time: 0.05, size: 0.05}"},
            false}}) {
    for (const char* name : {"walk_flat", "step_down"}) {
      SCOPED_TRACE(std::string(name) + ": " + wrong.what);
      std::vector<std::string> changes{"randomise.include=mismatch"};
      for (const std::string& fault : wrong.faults) {
        changes.push_back("sensors.faults.n" + std::to_string(changes.size()) + "=" + fault);
      }
      Loop loop(scenario(name, changes, 3));
      loop.tick();  // which has no torque before it
      const Beginning beginning = begin(loop);
      EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
      EXPECT_LT(beginning.tilt_error, 0.03);
      EXPECT_LT(beginning.largest_change, control::SafetyOptions{}.max_torque_change + 1e-9);
      EXPECT_EQ(loop.allocations(), 0U) << loop.last_allocation();
      EXPECT_EQ(loop.count(PlanEvent::begun_anew) > 0, wrong.begins_anew);
    }
  }
}

TEST(Beginning, TheFirstClockMayBeWrong) {
  for (const double off : {1000.0, 1.0, -1.0, 0.05}) {
    SCOPED_TRACE(off);
    Loop loop(scenario("walk_flat", {}, 1));
    int tick = 0;
    loop.change_readings([&](SensorReading& reading) {
      if (tick++ > 0) return;
      for (double* time :
           {&reading.time, &reading.encoder_time, &reading.torque_time, &reading.imu_time}) {
        *time += off;
      }
    });
    loop.tick();
    const Beginning beginning = begin(loop);
    EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
    EXPECT_LT(beginning.tilt_error, 0.03);
    EXPECT_LT(beginning.largest_change, control::SafetyOptions{}.max_torque_change + 1e-9);
    EXPECT_EQ(loop.count(PlanEvent::begun_anew), 1);
    EXPECT_NEAR(loop.record().state.time, 2.0, 0.01);
  }
}

// Each sample of these is bridged once the beginning is over.
TEST(Beginning, WhatIsWrongAgainAndAgainKeepsNoRobotFromWalking) {
  std::vector<std::string> changes{"planner.calibration.duration=0"};
  for (int i = 0; i < 60; ++i) {
    changes.push_back("sensors.faults.n" + std::to_string(i) +
                      "={sensor: encoders, kind: spike, size: 0.06, joint: LF_KFE, time: " +
                      std::to_string(0.1 * i) + "}");
  }
  Loop loop(scenario("walk_flat", changes, 1));
  loop.run_until(6.0);
  EXPECT_EQ(loop.record().command.mode, CommandMode::optimal);
  EXPECT_GT(loop.steps_taken(), 3);
}

}  // namespace
}  // namespace surefoot
