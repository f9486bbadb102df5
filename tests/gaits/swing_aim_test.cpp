#include "surefoot/gaits/parts/swing_curve.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

using test::Random;

SwingTarget target_to(const Vec3& goal) {
  return {.start = Vec3(1.0, 2.0, 0.1), .goal = goal, .duration = 0.25, .apex = 0.05};
}

TEST(SwingCurve, IsAimedElsewhereWithoutAJumpAndArrivesThere) {
  Random random(3);
  const SwingOptions options{.horizontal_start = 0.0, .horizontal_end = 1.0};
  for (int trial = 0; trial < 100; ++trial) {
    SwingCurve curve(target_to({1.4, 2.0, 0.1}), options);
    Vec3 goal = Vec3::Zero();
    for (double t = 0.01; t < 0.19; t += random.uniform(0.01, 0.05)) {
      goal = Vec3(1.4, 2.0, 0.1) + random.vector(0.05);
      const Motion<Vec3> before = curve.at(t);
      curve.aim(t, goal);
      const Motion<Vec3> after = curve.at(t);
      EXPECT_LT((after.p - before.p).norm(), 1e-9);
      EXPECT_LT((after.v - before.v).norm(), 1e-7);
      EXPECT_LT((after.a - before.a).norm(), 1e-5);
    }
    const Motion<Vec3> end = curve.at(0.25);
    EXPECT_LT((end.p - curve.target().goal).norm(), 1e-9);
    EXPECT_LT((end.p - goal).head<2>().norm(), 1e-9);
    EXPECT_LT(end.v.head<2>().norm(), 1e-7);
  }
}

TEST(SwingCurve, KeepsItsGoalWhereTooLittleTimeIsLeft) {
  SwingCurve curve(target_to({1.4, 2.0, 0.1}), {.horizontal_start = 0.0, .horizontal_end = 1.0});
  curve.aim(0.24, {1.5, 2.0, 0.2});
  EXPECT_LT((curve.at(0.25).p - Vec3(1.4, 2.0, 0.1)).norm(), 1e-9);
}

TEST(SwingCurve, IsAimedOnInTheSearchWithoutAJumpAndFollows) {
  const SwingOptions options{
      .horizontal_start = 0.0, .horizontal_end = 1.0, .touchdown_speed = 0.1, .search_speed = 1.0};
  for (const bool straight : {false, true}) {
    SwingTarget target = target_to({1.4, 2.0, 0.1});
    target.straight = straight;
    SwingCurve curve(target, options);
    const SwingCurve still = curve;
    Vec3 goal = target.goal;
    for (double t = 0.2525; t < 0.9; t += 0.0025) {
      goal.x() += 0.5 * 0.0025;
      const Motion<Vec3> before = curve.at(t);
      curve.aim(t, goal);
      const Motion<Vec3> after = curve.at(t);
      EXPECT_LT((after.p - before.p).norm(), 1e-9) << t;
      EXPECT_LT((after.v - before.v).norm(), 1e-7) << t;
      EXPECT_LT((after.a - before.a).norm(), 1e-5) << t;
      EXPECT_NEAR(after.p.z(), still.at(t).p.z(), 1e-9) << "as deep as without";
    }
    EXPECT_NEAR(curve.at(0.9).v.x(), 0.5, 0.01) << straight;
    EXPECT_NEAR(curve.at(0.9).p.x(), goal.x(), 0.05) << straight;
  }
}

TEST(SwingCurve, SearchesAtOnceAtFullSpeedWhereContactWasLost) {
  SwingTarget target = target_to({1.0, 2.0, 0.05});
  target.straight = true;
  const SwingCurve curve(target, {.touchdown_speed = 0.1, .search_speed = 0.6});
  EXPECT_NEAR(curve.at(0.25).v.z(), -0.6, 1e-9);
  EXPECT_NEAR(curve.at(0.35).p.z(), 0.05 - 0.06, 1e-9);
}

TEST(SwingCurve, SearchesFasterAndFasterUpToItsSpeed) {
  const SwingCurve curve(target_to({1.4, 2.0, 0.1}), {.touchdown_speed = 0.1, .search_speed = 0.6});
  EXPECT_NEAR(curve.at(0.25).v.z(), -0.1, 1e-9);
  EXPECT_NEAR(curve.at(0.275).v.z(), -0.35, 1e-6);
  EXPECT_NEAR(curve.at(0.5).v.z(), -0.6, 1e-9);
  const double dt = 1e-5;
  for (double t = 0.251; t < 0.4; t += 0.01) {
    const double slope = (curve.at(t + dt).p.z() - curve.at(t).p.z()) / dt;
    EXPECT_NEAR(slope, curve.at(t).v.z(), 1e-3) << t;
  }
}

}  // namespace
}  // namespace surefoot::gaits
