#include "surefoot/estimation/reading_guard.hpp"

#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr int kKnee = 2;  // LF_KFE

/// A robot whose joints swing and whose IMU shakes, tick by tick, read through a guard.
struct Swinging {
  explicit Swinging(int count = 0) { run(count); }

  [[nodiscard]] JointVector angle(double t) const {
    return description.q_nominal +
           JointVector::Constant(kNumLegJoints, amplitude * std::sin(8.0 * t));
  }
  [[nodiscard]] JointVector velocity(double t) const {
    return JointVector::Constant(kNumLegJoints, 8.0 * amplitude * std::cos(8.0 * t));
  }
  [[nodiscard]] SensorReading sample(double t) const {
    SensorReading reading;
    reading.time = reading.encoder_time = reading.torque_time = reading.imu_time = t;
    reading.q = angle(t);
    reading.torque = JointVector::Constant(kNumLegJoints, 20.0 * std::sin(5.0 * t));
    reading.gyro = Vec3(std::sin(7.0 * t), std::cos(7.0 * t), 0.1);
    reading.accelerometer = Vec3(std::cos(9.0 * t), std::sin(9.0 * t), kGravity);
    return reading;
  }
  /// One tick with the reading that a test made of the true one.
  template <typename Change>
  void tick(const Change& change) {
    time = kPeriod * ++ticks;
    SensorReading reading = sample(time);
    change(reading);
    guard.update(reading, velocity(time - 0.5 * kPeriod));
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) tick([](SensorReading&) {});
  }
  [[nodiscard]] bool is_well() const {
    const SensorHealth& health = guard.health();
    return health.encoders.fault == SampleFault::none &&
           health.joint_torques.fault == SampleFault::none && health.imu.fault == SampleFault::none;
  }

  model::RobotDescription description = test::anymal_b();
  ReadingGuard guard{{}, description, kPeriod};
  int ticks = 0;
  double time = 0.0;
  double amplitude = 0.3;  // [rad]
};

TEST(ReadingGuard, GoodReadingsPassAsTheyAre) {
  Swinging robot;
  for (int i = 0; i < 400; ++i) {
    robot.run(1);
    ASSERT_TRUE(robot.is_well());
    ASSERT_EQ(robot.guard.repaired().q, robot.angle(robot.time));
    ASSERT_EQ(robot.guard.health().imu.age, 0.0);
  }
}

TEST(ReadingGuard, JointsWithoutReadingGoOnWithTheirVelocity) {
  Swinging robot(100);
  for (int i = 1; i <= 6; ++i) {
    robot.tick([](SensorReading& reading) { reading.q.setConstant(kNaN); });
    EXPECT_EQ(robot.guard.health().encoders.fault, SampleFault::not_a_number);
    EXPECT_NEAR(robot.guard.health().encoders.age, i * kPeriod, 1e-12);
    EXPECT_LT((robot.guard.repaired().q - robot.angle(robot.time)).norm(), 1e-3);
    EXPECT_TRUE(robot.guard.measured().q.array().isNaN().all());
  }
  robot.run(1);
  EXPECT_TRUE(robot.is_well());
}

TEST(ReadingGuard, TorquesAndImuHoldTheLastGoodValue) {
  Swinging robot(100);
  const SensorReading good = robot.guard.repaired();
  robot.tick([](SensorReading& reading) {
    reading.torque[4] = std::numeric_limits<double>::infinity();
    reading.gyro[1] = kNaN;
    reading.accelerometer[2] = -1e5;
  });
  EXPECT_EQ(robot.guard.repaired().torque[4], good.torque[4]);
  EXPECT_EQ(robot.guard.repaired().gyro[1], good.gyro[1]);
  EXPECT_EQ(robot.guard.repaired().accelerometer[2], good.accelerometer[2]);
  EXPECT_EQ(robot.guard.health().joint_torques.joint, 4);
  EXPECT_EQ(robot.guard.health().imu.fault, SampleFault::not_a_number);
}

TEST(ReadingGuard, ASpikeIsFoundAndLeavesNoTraceThoughARobotCouldMakeIt) {
  struct Case {
    double q, torque, gyro, accelerometer;
  };
  for (const Case& spike : {Case{0.2, -120.0, 5.0, 200.0}, Case{0.0, -60.0, 1.0, 100.0}}) {
    Swinging robot(100), other(101);
    robot.tick([&](SensorReading& reading) {
      reading.q[kKnee] += spike.q;
      reading.torque[kKnee] += spike.torque;
      reading.gyro[0] += spike.gyro;
      reading.accelerometer[0] += spike.accelerometer;
    });
    EXPECT_EQ(robot.guard.health().encoders.joint, spike.q > 0.0 ? kKnee : -1);
    EXPECT_NE(robot.guard.health().joint_torques.fault, SampleFault::none);
    EXPECT_EQ(robot.guard.health().imu.fault, SampleFault::jump);
    robot.run(1);
    other.run(1);
    EXPECT_TRUE(robot.is_well());
    EXPECT_EQ(robot.guard.repaired().q, other.guard.repaired().q);
    EXPECT_EQ(robot.guard.repaired().torque, other.guard.repaired().torque);
    EXPECT_EQ(robot.guard.repaired().gyro, other.guard.repaired().gyro);
    EXPECT_EQ(robot.guard.repaired().accelerometer, other.guard.repaired().accelerometer);
  }
}

TEST(ReadingGuard, AnImuThatIsHitIsBelievedASampleLater) {
  Swinging robot(100);
  const auto hit = [](SensorReading& reading) {
    reading.gyro[0] += 2.0;
    reading.accelerometer[0] += 100.0;
  };
  robot.tick(hit);
  EXPECT_EQ(robot.guard.health().imu.fault, SampleFault::jump);
  for (int i = 0; i < 4; ++i) {
    robot.tick(hit);
    EXPECT_TRUE(robot.is_well());
    EXPECT_GT(robot.guard.repaired().accelerometer[0], 90.0);
  }
}

// Both sense an impact.
TEST(ReadingGuard, AStepOfOneInstrumentOfTheImuIsBelievedWhereTheOtherMadeOneToo) {
  constexpr int kBridged = 8;  // samples in 20 ms
  for (const bool turns : {true, false}) {
    for (const double other : {0.0, 0.4, 0.6}) {  // of what is sure
      Swinging robot(100);
      const auto hit = [&](SensorReading& reading) {
        reading.gyro[0] += turns ? 1.0 : other * 0.6;
        reading.accelerometer[1] += turns ? other * 25.0 : 40.0;
      };
      for (int i = 0; i < kBridged; ++i) {
        robot.tick(hit);
        EXPECT_EQ(robot.is_well(), other > 0.5 && i > 0) << turns << other << i;
        EXPECT_TRUE(robot.guard.is_shaken());
      }
    }
  }
}

TEST(ReadingGuard, AnInstrumentOfTheImuThatIsOffForAMomentLeavesNoTrace) {
  const std::array<std::function<void(SensorReading&)>, 2> faults{
      [](SensorReading& reading) { reading.gyro[0] += 1.0; },
      [](SensorReading& reading) { reading.accelerometer[0] += 100.0; }};
  for (const auto& fault : faults) {
    for (int moment = 1; moment < 8; ++moment) {
      Swinging robot(100), other(100 + moment + 1);
      for (int i = 0; i < moment; ++i) robot.tick(fault);
      EXPECT_FALSE(robot.is_well());
      robot.run(1);
      EXPECT_TRUE(robot.is_well());
      EXPECT_EQ(robot.guard.repaired().gyro, other.guard.repaired().gyro);
      EXPECT_EQ(robot.guard.repaired().accelerometer, other.guard.repaired().accelerometer);
    }
  }
}

TEST(ReadingGuard, ASlowImuMayStepFurther) {
  for (const int every : {1, 2, 4}) {
    for (const double step : {0.95, 1.05}) {
      Swinging robot;
      int at = 0;
      bool is_off = false;
      const auto sampled = [&](SensorReading& reading) {
        reading.imu_time = kPeriod * (robot.ticks - at++ % every);
        reading.gyro = Vec3(is_off ? step * every * 0.6 : 1e-4 * reading.imu_time, 0.0, 0.0);
        reading.accelerometer = Vec3(0.0, 1e-4 * reading.imu_time, kGravity);
      };
      for (int i = 0; i < 100; ++i) robot.tick(sampled);
      ASSERT_TRUE(robot.is_well());
      is_off = true;
      robot.tick(sampled);
      EXPECT_EQ(robot.is_well(), step < 1.0) << every;
    }
  }
}

// Further than any robot goes they are never believed, but of one that is not controlled.
TEST(ReadingGuard, JointsThatAllJumpWaitForOneSample) {
  for (const auto& [far, is_loose] :
       {std::pair(0.01, false), std::pair(0.015, false), std::pair(0.03, false),
        std::pair(0.06, false), std::pair(0.3, false), std::pair(0.06, true)}) {
    Swinging robot(100);
    robot.guard.set_loose(is_loose);
    for (int tick = 0; tick < 7; ++tick) {
      robot.tick([&](SensorReading& reading) { reading.q.array() += far; });
      const bool is_believed = tick > 0 && (far < 0.02 || is_loose);
      EXPECT_EQ(robot.guard.health().encoders.fault,
                is_believed ? SampleFault::none : SampleFault::jump)
          << far << " " << tick;
    }
    robot.run(2);
    EXPECT_EQ(robot.guard.health().encoders.fault, SampleFault::none) << far;
  }
}

TEST(ReadingGuard, IsShakenFor20MsByAStepThatNoWalkShowsAlsoWhereItIsBelieved) {
  for (const int sensor : {0, 1, 2}) {
    Swinging robot(100);
    EXPECT_FALSE(robot.guard.is_shaken());
    for (int tick = 0; tick < 2; ++tick) {
      robot.tick([&](SensorReading& reading) {
        if (sensor == 0) reading.gyro.x() += 2.0;
        if (sensor == 1) reading.accelerometer.z() += 60.0;
        if (sensor == 2) reading.q.array() += 0.01;
      });
      EXPECT_TRUE(robot.guard.is_shaken()) << sensor;
    }
    robot.run(6);
    EXPECT_TRUE(robot.guard.is_shaken()) << sensor;
    robot.run(10);
    EXPECT_FALSE(robot.guard.is_shaken()) << sensor;
  }
}

TEST(ReadingGuard, JointsOfARobotThatIsHitAreNotDoubted) {
  for (const double hit : {0.0, 100.0, 200.0}) {
    Swinging robot(100);
    robot.tick([&](SensorReading& reading) {
      reading.accelerometer[2] += hit;
      reading.gyro[0] += 0.005 * hit;
    });
    robot.tick([](SensorReading& reading) { reading.q.array() += 0.03; });
    EXPECT_EQ(robot.guard.health().encoders.fault,
              hit > 0.0 ? SampleFault::none : SampleFault::jump);
  }
}

TEST(ReadingGuard, JointsThatAllJumpWithTheAccelerometerAloneAreNotBelieved) {
  Swinging robot(100);
  for (int i = 0; i < 7; ++i) {
    robot.tick([](SensorReading& reading) {
      reading.accelerometer[2] += 60.0;
      reading.q.array() += 0.1;
    });
    EXPECT_EQ(robot.guard.health().encoders.fault, SampleFault::jump) << i;
  }
}

TEST(ReadingGuard, WhatCanNotBeVouchesForNothing) {
  for (const double other : {1e5, kNaN}) {
    Swinging robot(100);
    for (int i = 0; i < 4; ++i) {
      robot.tick([&](SensorReading& reading) {
        reading.gyro[0] += 1.0;
        reading.accelerometer[1] += other;
      });
      EXPECT_LT(robot.guard.repaired().gyro[0], 1.0) << other << i;
    }
  }
}

// Per period, like the sure limits.
TEST(ReadingGuard, BehindAGapAnImuMayHaveGoneFurther) {
  Swinging robot(100);
  const Vec3 before = robot.sample(robot.time).gyro;
  for (int i = 0; i < 4; ++i) {
    robot.tick([](SensorReading& reading) { reading.gyro.setConstant(kNaN); });
  }
  robot.tick([&](SensorReading& reading) { reading.gyro = before + Vec3(2.0, 0.0, 0.0); });
  EXPECT_TRUE(robot.is_well());
}

TEST(ReadingGuard, AJumpThatStaysIsNotBelievedWithinTheTimeThatIsBridged) {
  Swinging robot(100);
  for (int i = 1; i <= 9; ++i) {
    robot.tick([](SensorReading& reading) {
      reading.q[kKnee] += 0.15;
      reading.gyro[0] += 5.0;
    });
    EXPECT_EQ(robot.guard.health().encoders.joint, kKnee) << i;
    EXPECT_NEAR(robot.guard.health().encoders.age, i * kPeriod, 1e-12);
    EXPECT_NEAR(robot.guard.health().imu.age, i * kPeriod, 1e-12);
  }
}

TEST(ReadingGuard, SilenceShowsInTheSampleTimes) {
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

TEST(ReadingGuard, ASlowSensorIsNotAtFault) {
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

TEST(ReadingGuard, AConstantDelayIsNoFaultAndATooLongOneIs) {
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

TEST(ReadingGuard, SamplesThatComeLaterThanTheRobotBearsAreToldButUsed) {
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

TEST(ReadingGuard, TheSameNumbersAgainAndAgainAreNoMeasurement) {
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
TEST(ReadingGuard, NumbersThatStayTheSameAreFoundUnderACorrectionThatChanges) {
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
TEST(ReadingGuard, ASampleThatWasThereBeforeIsNotMeasuredAgain) {
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

TEST(ReadingGuard, ALateSampleShiftsNoTorquesAgainstAngles) {
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

TEST(ReadingGuard, NoSampleOfAnotherTimeThanUsualIsMeasured) {
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

TEST(ReadingGuard, WhatTheRobotDoesNotHaveHasNoAge) {
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

TEST(ReadingGuard, ASampleTimeThatIsNoneOrAheadIsThatOfTheReading) {
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

TEST(ReadingGuard, AClockThatLeapsChangesNothing) {
  Swinging robot(100);
  for (const double leap : {1e6, -1e6, 5.0, 0.5, 0.02, -0.02, kNaN}) {
    robot.tick([&](SensorReading& reading) { reading.time += leap; });
    EXPECT_FALSE(robot.guard.clock_is_right()) << leap;
    robot.run(1);
    EXPECT_TRUE(robot.is_well());
    EXPECT_EQ(robot.guard.repaired().q, robot.angle(robot.time));
  }
}

TEST(ReadingGuard, ATickOrTwoThatWereMissedAreNoLeap) {
  Swinging robot(100);
  for (const int missed : {1, 2, 3}) {
    robot.ticks += missed;
    robot.run(1);
    EXPECT_TRUE(robot.guard.clock_is_right()) << missed;
  }
}

// So is everything after it: the joints may be anywhere.
TEST(ReadingGuard, APauseIsBelievedWhenTheClockGoesOnFromIt) {
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

TEST(ReadingGuard, WithoutAClockAllSensorsAreSilent) {
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

TEST(ReadingGuard, OfALateSensorSilenceWithoutAClockIsNoLongerThanOfOthers) {
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

TEST(ReadingGuard, WithoutAClockOnlyAnglesThatCanBeAreMeasured) {
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

TEST(ReadingGuard, ADeadDriversLastReadingIsNotMeasuredThoughItsClockWasWrong) {
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
