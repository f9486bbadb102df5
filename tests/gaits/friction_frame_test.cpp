#include "surefoot/gaits/parts/friction_frame.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::gaits {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;

Vec3 leaning(double roll, double pitch) {
  return from_roll_pitch_yaw({roll, pitch, 0.0}) * Vec3::UnitZ();
}

double angle(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

TEST(FrictionFrame, ComesToTheNormalOfThePlane) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    FrictionFrame frame({}, kPeriod);
    const Vec3 normal = leaning(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3));
    for (double t = 0.0; t < 3.0; t += kPeriod) frame.update(normal);
    EXPECT_LT(angle(frame.normal(), normal), 1e-6);
  }
}

TEST(FrictionFrame, NeverTurnsFasterThanItsRateWhereverThePlaneJumps) {
  Random random(2);
  const FrictionFrameOptions options;
  FrictionFrame frame(options, kPeriod);
  Vec3 plane = Vec3::UnitZ();
  for (int tick = 0; tick < 4000; ++tick) {
    if (tick % 100 == 0) plane = leaning(random.uniform(-0.35, 0.35), random.uniform(-0.35, 0.35));
    const Vec3 before = frame.normal();
    frame.update(plane);
    ASSERT_LE(angle(before, frame.normal()), options.rate_max * kPeriod + 1e-12) << tick;
    ASSERT_NEAR(frame.normal().norm(), 1.0, 1e-12);
  }
}

TEST(FrictionFrame, GoesASmallWayInTheTimeOfItsFilter) {
  const FrictionFrameOptions options{.time_constant = 0.2, .rate_max = 100.0};
  FrictionFrame frame(options, kPeriod);
  const Vec3 normal = leaning(0.01, 0.0);
  for (double t = kPeriod; t < 1.0; t += kPeriod) {
    frame.update(normal);
    const double left = std::exp(-t / options.time_constant);
    ASSERT_NEAR(angle(frame.normal(), normal), 0.01 * left, 0.01 * 0.01) << t;
  }
}

TEST(FrictionFrame, WithoutAFilterIsThatOfThePlane) {
  FrictionFrame frame({.time_constant = 0.0, .rate_max = 1e3}, kPeriod);
  frame.update(leaning(0.2, -0.1));
  EXPECT_LT(angle(frame.normal(), leaning(0.2, -0.1)), 1e-12);
}

}  // namespace
}  // namespace surefoot::gaits
