#include "tests/estimation/swinging.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace surefoot::estimation {
namespace {

using test::Swinging;

constexpr double kPeriod = Swinging::kPeriod;
constexpr int kKnee = 2;  // LF_KFE

TEST(GuardedTimes, SilenceShowsInTheSampleTimes) {
  Swinging robot(100);
  const SensorReading last = robot.guard.repaired();
  for (int i = 1; i <= 9; ++i) {
    robot.tick([&](SensorReading& reading) {
      reading.q = last.q;
      reading.encoder_time = last.encoder_time;
      reading.gyro = last.gyro;
      reading.accelerometer = last.accelerometer;
      reading.imu_time = last.imu_time;
    });
    EXPECT_EQ(robot.guard.health().encoders.fault, SampleFault::silent) << i;
    EXPECT_EQ(robot.guard.health().encoders.joint, -1);
    EXPECT_EQ(robot.guard.health().imu.fault, SampleFault::silent) << i;
    EXPECT_NEAR(robot.guard.health().imu.age, i * kPeriod, 1e-12);
    EXPECT_EQ(robot.guard.health().joint_torques.fault, SampleFault::none);
  }
}

TEST(GuardedTimes, ASlowSensorIsNotAtFault) {
  for (const int every : {2, 3, 4, 8}) {
    Swinging robot;
    SensorReading held;
    for (int i = 0; i < 800; ++i) {
      robot.tick([&](SensorReading& reading) {
        if (i % every == 0) held = reading;
        reading.q = held.q;
        reading.gyro = held.gyro;
        reading.accelerometer = held.accelerometer;
        reading.encoder_time = reading.imu_time = held.time;
      });
      ASSERT_TRUE(robot.is_well()) << every << " " << i;
      ASSERT_LE(robot.guard.health().imu.age, every * kPeriod);
    }
  }
}

TEST(GuardedTimes, AConstantDelayIsNoFaultAndATooLongOneIs) {
  for (const int delay : {1, 3, 4, 5, 9}) {
    Swinging robot;
    for (int i = 0; i < 400; ++i) {
      robot.tick([&](SensorReading& reading) {
        const SensorReading past = robot.sample(std::max(0.0, robot.time - delay * kPeriod));
        reading.gyro = past.gyro;
        reading.accelerometer = past.accelerometer;
        reading.imu_time = past.time;
      });
      ASSERT_TRUE(robot.is_well() || delay > 4) << delay << " " << i;
    }
    const GroupHealth& imu = robot.guard.health().imu;
    EXPECT_EQ(imu.fault, delay > 4 ? SampleFault::late : SampleFault::none) << delay;
    EXPECT_EQ(imu.age > 0.02, delay > 4) << "10 ms, and 11 are allowed";
  }
}

TEST(GuardedTimes, SamplesThatComeLaterThanTheRobotBearsAreToldButUsed) {
  const ReadingGuardOptions options;
  for (const auto& [limit, group] :
       {std::pair(options.max_encoder_delay, &SensorHealth::encoders),
        std::pair(options.max_torque_delay, &SensorHealth::joint_torques),
        std::pair(options.max_imu_delay, &SensorHealth::imu)}) {
    const int most = static_cast<int>(limit / kPeriod);
    for (const int delay : {most, most + 1}) {
      Swinging robot(200);
      SensorReading past;
      for (int i = 0; i < 20; ++i) {
        robot.tick([&](SensorReading& reading) {
          past = robot.sample(robot.time - delay * kPeriod);
          past.time = reading.time;
          reading = past;
        });
      }
      const bool is_late = delay > most;
      const GroupHealth& health = robot.guard.health().*group;
      EXPECT_EQ(health.fault == SampleFault::late, is_late) << delay;
      EXPECT_EQ(health.age > 0.02, is_late) << delay;
      EXPECT_EQ(robot.guard.repaired().q, past.q);
      EXPECT_EQ(robot.guard.repaired().gyro, past.gyro);
      robot.run(10);
      EXPECT_EQ((robot.guard.health().*group).fault, SampleFault::none);
    }
  }
}

TEST(GuardedTimes, TheSameNumbersAgainAndAgainAreNoMeasurement) {
  Swinging robot(100);
  const SensorReading last = robot.guard.repaired();
  for (int i = 1; i <= 9; ++i) {
    robot.tick([&](SensorReading& reading) { reading.gyro = last.gyro; });
    const bool is_believed = i < ReadingGuardOptions{}.repeats;
    EXPECT_EQ(robot.guard.health().imu.fault,
              is_believed ? SampleFault::none : SampleFault::repeats);
  }
  EXPECT_NEAR(robot.guard.health().imu.age, 9 * kPeriod, 1e-12) << "since the first of them";
}

// The raw readings: corrections change from tick to tick while they fade in.
TEST(GuardedTimes, NumbersThatStayTheSameAreFoundUnderACorrectionThatChanges) {
  Swinging robot(100);
  const SensorReading last = robot.guard.repaired();
  for (int i = 1; i <= ReadingGuardOptions{}.repeats; ++i) {
    robot.time = kPeriod * ++robot.ticks;
    SensorReading given = robot.sample(robot.time);
    given.gyro = last.gyro;
    SensorReading corrected = given;
    corrected.gyro += Vec3::Constant(1e-6 * i);
    robot.guard.update(corrected, robot.velocity(robot.time), given);
  }
  EXPECT_EQ(robot.guard.health().imu.fault, SampleFault::repeats);
}

// Held angles would look like joints that stop and leap.
TEST(GuardedTimes, ASampleThatWasThereBeforeIsNotMeasuredAgain) {
  Swinging robot(2);
  for (int i = 0; i < 100; ++i) {
    robot.run(1);
    EXPECT_EQ(robot.guard.measured().q, robot.angle(robot.time));
    const SensorReading last = robot.sample(robot.time);
    robot.tick([&](SensorReading& reading) {
      reading.q = last.q;
      reading.encoder_time = last.encoder_time;
    });
    EXPECT_TRUE(robot.guard.measured().q.array().isNaN().all());
    if (i < 50) continue;  // until it is known to be slow
    EXPECT_TRUE(robot.is_well());
    EXPECT_EQ(robot.guard.repaired().q, last.q);
    EXPECT_EQ(robot.guard.joint_lag(), robot.time - last.encoder_time);
  }
}

TEST(GuardedTimes, ALateSampleShiftsNoTorquesAgainstAngles) {
  Swinging robot;
  const auto late = [&](SensorReading& reading) {
    const SensorReading before = robot.sample(robot.time - kPeriod);
    reading.torque = before.torque;
    reading.torque_time = before.torque_time;
  };
  for (int i = 0; i < 40; ++i) robot.tick(late);
  EXPECT_NEAR(robot.guard.torque_delay(), kPeriod, 1e-12);
  const SensorReading held = robot.sample(robot.time - kPeriod);
  robot.tick([&](SensorReading& reading) {
    reading.torque = held.torque;
    reading.torque_time = held.torque_time;
  });
  EXPECT_NEAR(robot.guard.torque_delay(), kPeriod, 1e-12);
}

TEST(GuardedTimes, NoSampleOfAnotherTimeThanUsualIsMeasured) {
  Swinging robot;
  robot.amplitude = 0.1;  // all joints at once, quicker, are doubted
  robot.run(40);
  const auto late = [&](SensorReading& reading) {
    const SensorReading before = robot.sample(robot.time - kPeriod);
    reading.q = before.q;
    reading.encoder_time = before.encoder_time;
  };
  for (int i = 0; i < 2; ++i) {
    robot.tick(late);
    EXPECT_TRUE(robot.guard.measured().q.array().isNaN().all()) << i;
    EXPECT_NEAR(robot.guard.encoder_delay(), 0.0, 1e-12);
  }
  EXPECT_EQ(robot.guard.repaired().q, robot.angle(robot.time - kPeriod)) << "it is new";
  robot.run(1);
  EXPECT_TRUE(robot.guard.measured().q.allFinite());
}

TEST(GuardedTimes, WhatTheRobotDoesNotHaveHasNoAge) {
  Swinging robot;
  for (int i = 0; i < 50; ++i) {
    robot.tick([](SensorReading& reading) {
      reading.gyro.setConstant(kNaN);
      reading.accelerometer.setConstant(kNaN);
      reading.imu_time = kNaN;
    });
  }
  EXPECT_TRUE(std::isnan(robot.guard.health().imu.age));
  EXPECT_EQ(robot.guard.health().encoders.age, 0.0);
}

TEST(GuardedTimes, ASampleTimeThatIsNoneOrAheadIsThatOfTheReading) {
  Swinging robot;
  for (const double told : {kNaN, 1e3}) {
    robot.tick([&](SensorReading& reading) {
      reading.encoder_time = reading.torque_time = reading.imu_time = told;
    });
    const SensorReading& used = robot.guard.repaired();
    EXPECT_EQ(used.encoder_time, used.time);
    EXPECT_EQ(used.torque_time, used.time);
    EXPECT_EQ(used.imu_time, used.time);
    EXPECT_TRUE(robot.is_well());
  }
}

TEST(GuardedTimes, AClockThatLeapsChangesNothing) {
  Swinging robot(100);
  for (const double leap : {1e6, -1e6, 5.0, 0.5, 0.02, -0.02, kNaN}) {
    robot.tick([&](SensorReading& reading) { reading.time += leap; });
    EXPECT_FALSE(robot.guard.clock_is_right()) << leap;
    robot.run(1);
    EXPECT_TRUE(robot.is_well());
    EXPECT_EQ(robot.guard.repaired().q, robot.angle(robot.time));
  }
}

TEST(GuardedTimes, ATickOrTwoThatWereMissedAreNoLeap) {
  Swinging robot(100);
  for (const int missed : {1, 2, 3}) {
    robot.ticks += missed;
    robot.run(1);
    EXPECT_TRUE(robot.guard.clock_is_right()) << missed;
  }
}

// So is everything after it: the joints may be anywhere.
TEST(GuardedTimes, APauseIsBelievedWhenTheClockGoesOnFromIt) {
  const auto elsewhere = [](SensorReading& reading) { reading.q.array() += 0.5; };
  for (const auto& [pause, is_believed] : {std::pair(0.05, true), std::pair(0.3, false)}) {
    Swinging robot(100);
    robot.ticks += static_cast<int>(std::round(pause / kPeriod));
    robot.tick(elsewhere);
    EXPECT_FALSE(robot.guard.clock_is_right());
    for (int i = 0; i < 20; ++i) {
      robot.tick(elsewhere);
      ASSERT_EQ(robot.guard.clock_is_right(), is_believed) << pause;
      ASSERT_EQ(robot.is_well(), is_believed) << pause;
    }
  }
}

TEST(GuardedTimes, WithoutAClockAllSensorsAreSilent) {
  Swinging robot(100);
  for (const double clock : {robot.time, kNaN, -3.0}) {
    SensorReading dead = robot.guard.repaired();
    dead.time = clock;
    for (int i = 1; i <= 9; ++i) {
      robot.guard.update(dead, JointVector::Zero(kNumLegJoints));
      const SensorHealth& health = robot.guard.health();
      for (const GroupHealth& group : {health.encoders, health.joint_torques, health.imu}) {
        EXPECT_EQ(group.fault, SampleFault::silent);
        EXPECT_NEAR(group.age, i * kPeriod, 1e-12);
        EXPECT_EQ(group.joint, -1);
      }
    }
    robot.run(1);
    EXPECT_TRUE(robot.is_well());
    EXPECT_EQ(robot.guard.health().imu.age, 0.0);
  }
}

TEST(GuardedTimes, OfALateSensorSilenceWithoutAClockIsNoLongerThanOfOthers) {
  Swinging robot;
  for (int i = 0; i < 200; ++i) {
    robot.tick([&](SensorReading& reading) { reading.imu_time -= 0.01; });
  }
  SensorReading dead = robot.guard.repaired();
  for (int i = 1; i <= 8; ++i) {
    robot.guard.update(dead, JointVector::Zero(kNumLegJoints));
    EXPECT_LE(robot.guard.health().imu.age, 0.02 + 1e-9) << i;
  }
  robot.guard.update(dead, JointVector::Zero(kNumLegJoints));
  EXPECT_GT(robot.guard.health().imu.age, 0.02);
}

TEST(GuardedTimes, WithoutAClockOnlyAnglesThatCanBeAreMeasured) {
  Swinging robot(100);
  SensorReading reading = robot.guard.repaired();
  const JointVector before = reading.q;
  reading.time = 0.0;
  reading.q[kKnee] = 0.0;
  reading.q[7] = kNaN;
  reading.gyro.setConstant(1e9);
  const auto repeat = [&](double step) {
    reading.q[4] += step;
    robot.guard.update(reading, JointVector::Zero(kNumLegJoints));
  };
  for (int i = 1; i <= 8; ++i) {
    repeat(1e-3);
    EXPECT_TRUE(robot.guard.measured().q.array().isNaN().all()) << "bridged";
  }
  repeat(1e-3);
  const SensorReading& measured = robot.guard.measured();
  EXPECT_TRUE(std::isnan(measured.time));
  EXPECT_EQ(measured.q[4], reading.q[4]);
  EXPECT_NE(measured.q[4], before[4]);
  EXPECT_TRUE(std::isnan(measured.q[kKnee]));
  EXPECT_TRUE(std::isnan(measured.q[7]));
  EXPECT_LT(measured.gyro.norm(), 2.0);
  for (int i = 1; i <= 79; ++i) repeat(0.0);
  EXPECT_EQ(measured.q[4], reading.q[4]) << "a robot may be still for a while";
  repeat(0.0);
  EXPECT_TRUE(measured.q.array().isNaN().all()) << "a driver that is dead by now";
  repeat(1e-3);
  EXPECT_EQ(measured.q[4], reading.q[4]) << "it lives again";
}

TEST(GuardedTimes, ADeadDriversLastReadingIsNotMeasuredThoughItsClockWasWrong) {
  Swinging robot(100);
  SensorReading reading = robot.guard.repaired();
  reading.time = kNaN;
  reading.q[4] += 1e-3;
  reading.q[7] = kNaN;
  for (int i = 0; i < 80; ++i) robot.guard.update(reading, JointVector::Zero(kNumLegJoints));
  for (int i = 0; i < 100; ++i) {
    robot.guard.update(reading, JointVector::Zero(kNumLegJoints));
    EXPECT_TRUE(robot.guard.measured().q.array().isNaN().all()) << i;
  }
  EXPECT_EQ(robot.guard.health().encoders.fault, SampleFault::silent);
}

}  // namespace
}  // namespace surefoot::estimation
