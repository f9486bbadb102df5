#include "surefoot/estimation/foot_sensor_trust.hpp"

#include "surefoot/math/numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;  // [s]

TEST(FootSensorTrust, IsOfAFootInTheAirAndLessAndLessAsItBears) {
  FootSensorTrust trust(kPeriod);
  for (int i = 0; i < 400; ++i) {
    EXPECT_EQ(trust.force(9.0, 0.0), 9.0);
    EXPECT_EQ(trust.force(20.0, 10.0), 20.0);
    EXPECT_DOUBLE_EQ(trust.force(30.0, 20.0), 25.0);
    EXPECT_EQ(trust.force(60.0, 30.0), 30.0);
    EXPECT_EQ(trust.force(80.0, 100.0), 100.0);
  }
}

TEST(FootSensorTrust, ATouchIsFeltBeforeTheJointsTellItButNotAllOfIt) {
  FootSensorTrust trust(kPeriod);
  double before = 0.0;
  for (int i = 0; i < 20; ++i) {
    const double by_joints = 2.0 * i;
    const double force = trust.force(150.0, by_joints);
    if (by_joints <= 10.0) {
      EXPECT_DOUBLE_EQ(force, 40.0 + 1.3 * by_joints);
    }
    EXPECT_GE(force, by_joints);
    EXPECT_LT(std::abs(force - before), i == 0 ? 41.0 : 5.0) << "turns into that of the joints";
    before = force;
  }
  EXPECT_EQ(before, 38.0);
}

TEST(FootSensorTrust, OneThatFeelsATouchInTheAirIsLeftAfter50Milliseconds) {
  for (const double offset : {11.0, 20.0, 40.0, 300.0}) {
    FootSensorTrust trust(kPeriod);
    for (int i = 1; i <= 20; ++i) EXPECT_EQ(trust.force(offset, 0.0), std::min(offset, 40.0)) << i;
    for (int i = 0; i < 100; ++i) EXPECT_EQ(trust.force(offset, 0.0), 0.0) << offset;
  }
}

TEST(FootSensorTrust, OneThatTellsLessThanTheJointsIsNotBelievedAtOnce) {
  FootSensorTrust trust(kPeriod);
  EXPECT_EQ(trust.force(-5.0, 5.0), -5.0);
  EXPECT_EQ(trust.force(-60.0, 5.0), 5.0);
}

TEST(FootSensorTrust, OneThatWasLeftMustProveItself) {
  FootSensorTrust trust(kPeriod);
  for (int i = 1; i <= 20; ++i) EXPECT_DOUBLE_EQ(trust.force(120.0, 2.0), 42.6) << i;
  EXPECT_EQ(trust.force(120.0, 2.0), 2.0);
  for (int i = 0; i < 190; ++i) EXPECT_EQ(trust.force(8.0, 3.0), 3.0) << i;
  for (int i = 0; i < 20; ++i) (void)trust.force(8.0, 3.0);
  EXPECT_EQ(trust.force(8.0, 3.0), 8.0);
}

TEST(FootSensorTrust, WhatIsNoForceIsLeftOut) {
  FootSensorTrust trust(kPeriod);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e5}) {
    EXPECT_EQ(trust.force(bad, 5.0), 5.0);
  }
  EXPECT_EQ(trust.force(8.0, 5.0), 8.0);
}

TEST(FootSensorTrust, WhatIsNoForceIsNoProof) {
  FootSensorTrust trust(kPeriod);
  for (int i = 0; i < 30; ++i) (void)trust.force(120.0, 2.0);
  for (int i = 0; i < 195; ++i) EXPECT_EQ(trust.force(8.0, 3.0), 3.0) << i;
  EXPECT_EQ(trust.force(std::numeric_limits<double>::quiet_NaN(), 3.0), 3.0);
  for (int i = 0; i < 190; ++i) EXPECT_EQ(trust.force(8.0, 3.0), 3.0) << i;
}

TEST(FootSensorTrust, GoesWithTheRobotsMass) {
  FootSensorTrust reference(kPeriod);
  FootSensorTrust heavy(kPeriod, {.mass = 4.0});
  for (double sensed = -50.0; sensed < 150.0; sensed += 7.0) {
    for (double by_joints = -5.0; by_joints < 60.0; by_joints += 2.5) {
      const double expected = 4.0 * reference.force(sensed, by_joints);
      EXPECT_EQ(heavy.force(4.0 * sensed, 4.0 * by_joints), expected) << sensed << ' ' << by_joints;
    }
  }
}

}  // namespace
}  // namespace surefoot::estimation
