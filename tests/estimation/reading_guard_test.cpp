#include "tests/estimation/swinging.hpp"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>
#include <utility>

namespace surefoot::estimation {
namespace {

using test::Swinging;

constexpr double kPeriod = Swinging::kPeriod;
constexpr int kKnee = 2;  // LF_KFE

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

}  // namespace
}  // namespace surefoot::estimation
