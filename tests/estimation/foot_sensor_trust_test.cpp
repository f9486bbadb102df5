#include "surefoot/estimation/foot_sensor_trust.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;  // [s]

TEST(FootSensorTrust, ASensorThatFitsIsBelieved) {
  FootSensorTrust trust(kPeriod);
  for (int i = 0; i < 400; ++i) {
    EXPECT_EQ(trust.force(80.0, 100.0), 80.0);
    EXPECT_EQ(trust.force(30.0, 0.0), 30.0);
  }
}

TEST(FootSensorTrust, ATouchIsFeltBeforeTheJointsTellItButNotAllOfIt) {
  FootSensorTrust trust(kPeriod);
  for (int i = 0; i < 20; ++i) {
    const double by_joints = 5.0 * i;
    EXPECT_DOUBLE_EQ(trust.force(150.0, by_joints), std::min(150.0, 40.0 + 1.3 * by_joints));
  }
  for (int i = 0; i < 400; ++i) EXPECT_EQ(trust.force(150.0, 130.0), 150.0);
}

TEST(FootSensorTrust, OneThatTellsLessThanTheJointsIsNotBelievedAtOnce) {
  FootSensorTrust trust(kPeriod);
  EXPECT_EQ(trust.force(100.0, 110.0), 100.0);
  EXPECT_EQ(trust.force(0.0, 110.0), 110.0);
  EXPECT_EQ(trust.force(-60.0, 0.0), 0.0);
}

TEST(FootSensorTrust, OneThatStaysHighIsLeftAfter50MillisecondsAndMustProveItself) {
  FootSensorTrust trust(kPeriod);
  for (int i = 1; i <= 20; ++i) EXPECT_DOUBLE_EQ(trust.force(120.0, 2.0), 42.6) << i;
  EXPECT_EQ(trust.force(120.0, 2.0), 2.0);
  for (int i = 0; i < 190; ++i) EXPECT_EQ(trust.force(120.0, 110.0), 110.0) << i;
  for (int i = 0; i < 20; ++i) (void)trust.force(120.0, 110.0);
  EXPECT_EQ(trust.force(120.0, 110.0), 120.0);
}

TEST(FootSensorTrust, WhatIsNoForceIsLeftOut) {
  FootSensorTrust trust(kPeriod);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, 1e5}) {
    EXPECT_EQ(trust.force(bad, 50.0), 50.0);
  }
  EXPECT_EQ(trust.force(60.0, 50.0), 60.0);
}

TEST(FootSensorTrust, WhatIsNoForceIsNoProof) {
  FootSensorTrust trust(kPeriod);
  for (int i = 0; i < 30; ++i) (void)trust.force(120.0, 2.0);
  for (int i = 0; i < 195; ++i) EXPECT_EQ(trust.force(120.0, 110.0), 110.0) << i;
  EXPECT_EQ(trust.force(std::numeric_limits<double>::quiet_NaN(), 110.0), 110.0);
  for (int i = 0; i < 190; ++i) EXPECT_EQ(trust.force(120.0, 110.0), 110.0) << i;
}

}  // namespace
}  // namespace surefoot
