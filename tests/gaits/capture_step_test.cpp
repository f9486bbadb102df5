#include "surefoot/gaits/parts/capture_step.hpp"

#include "surefoot/gaits/parts/foothold_planner.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kReach = 0.3;  // [m]

/// The feet of a nominal stance, hips over them, and a robot that tips to the left by `out`.
CaptureProblem tipping_left(double out) {
  CaptureProblem problem;
  for (const Leg leg : kLegs) problem.feet[index(leg)] = nominal_offset({}, leg, kNumLegs);
  const double edge = problem.feet[index(Leg::LF)].y();
  problem.capture_point = {0.0, edge + out};
  problem.reach = kReach;
  return problem;
}

TEST(CaptureStep, AFootThatCatchesWhereItIsStaysThere) {
  CaptureProblem problem = tipping_left(0.0);
  problem.capture_point = {0.0, 0.0};
  problem.hip = problem.feet[index(Leg::LF)];
  const CaptureStep step = find_capture_step(problem, Leg::LF, {});
  EXPECT_EQ(step.goal, problem.feet[index(Leg::LF)]);
  EXPECT_GE(step.margin, PushOptions{}.capture_margin);
}

TEST(CaptureStep, GoesToTheSideThatTheRobotTipsTo) {
  CaptureProblem problem = tipping_left(0.05);
  problem.hip = problem.feet[index(Leg::LF)];
  const CaptureStep step = find_capture_step(problem, Leg::LF, {});
  EXPECT_GT(step.goal.y(), problem.feet[index(Leg::LF)].y() + 0.05);
  EXPECT_GT(step.margin, 0.0);
}

TEST(CaptureStep, AFootOnTheOtherSideDoesNotHelp) {
  CaptureProblem problem = tipping_left(0.05);
  problem.hip = problem.feet[index(Leg::RF)];
  EXPECT_LE(find_capture_step(problem, Leg::RF, {}).margin, 0.0);
}

TEST(CaptureStep, GoesInEveryDirectionThatTheRobotTipsTo) {
  const CaptureProblem standing = tipping_left(0.0);
  for (const Leg leg : kLegs) {
    const Vec2 corner = standing.feet[index(leg)];
    const Vec2 outward = corner.cwiseSign();  // backward and left, for the left hind leg
    CaptureProblem problem = standing;
    problem.capture_point = corner + 0.02 * outward;
    problem.hip = corner;
    ASSERT_LT(SupportRegion(problem.feet, {1.0, 1.0, 1.0, 1.0}).margin(problem.capture_point), 0.0);
    const CaptureStep step = find_capture_step(problem, leg, {});
    EXPECT_GT(outward.x() * (step.goal - corner).x(), 0.05) << kLegNames[index(leg)];
    EXPECT_GT(outward.y() * (step.goal - corner).y(), 0.05) << kLegNames[index(leg)];
    EXPECT_GT(step.margin, 0.0) << kLegNames[index(leg)];
  }
}

TEST(CaptureStep, GoesNoFurtherThanTheMarginAsksFor) {
  const PushOptions options;
  double last = 0.0;
  int shorter_ones = 0;
  for (int i = 0; i <= 60; ++i) {
    CaptureProblem problem = tipping_left(-0.12 + 0.005 * i);
    problem.capture_point.x() = 0.15;
    const Vec2 from = problem.feet[index(Leg::LF)];
    problem.hip = from;
    const CaptureStep step = find_capture_step(problem, Leg::LF, options);
    const double length = (step.goal - from).norm();
    EXPECT_GE(length, last - 1e-12) << "a robot that tips further needs no shorter step";
    last = length;
    if (length > 0.9 * options.step_max) continue;
    ++shorter_ones;
    EXPECT_GE(step.margin, options.capture_margin);
  }
  EXPECT_GT(shorter_ones, 20);
  EXPECT_NEAR(last, options.step_max, 1e-12);
}

TEST(CaptureStep, TurnsWithTheRobot) {
  test::RandomMatrices random(5);
  for (int trial = 0; trial < 50; ++trial) {
    CaptureProblem problem = tipping_left(random.uniform(0.0, 0.4));
    problem.capture_point += 0.2 * Vec2(random.vector(2));
    const CaptureStep step = find_capture_step(problem, Leg::LF, {});
    problem.heading = random.uniform(-3.0, 3.0);
    const Mat2 R = Eigen::Rotation2Dd(problem.heading).toRotationMatrix();
    for (Vec2& foot : problem.feet) foot = R * foot;
    problem.capture_point = R * problem.capture_point;
    problem.hip = R * problem.hip;
    const CaptureStep turned = find_capture_step(problem, Leg::LF, {});
    EXPECT_NEAR(turned.margin, step.margin, 1e-9);
    EXPECT_LT((turned.goal - R * step.goal).norm(), 1e-9);
  }
}

TEST(CaptureStep, IsWithinReachShortEnoughAndOffTheOtherFeet) {
  test::RandomMatrices random(3);
  const PushOptions options;
  for (int trial = 0; trial < 500; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    CaptureProblem problem = tipping_left(random.uniform(0.0, 0.4));
    const Leg leg = kLegs[static_cast<std::size_t>(random.integer(0, 3))];
    const Vec2 from = problem.feet[index(leg)];
    problem.capture_point += 0.2 * Vec2(random.vector(2));
    problem.hip = from + 0.1 * Vec2(random.vector(2)).normalized();
    const CaptureStep step = find_capture_step(problem, leg, options);
    EXPECT_LE((step.goal - problem.hip).norm(), kReach + 1e-12);
    EXPECT_LE((step.goal - from).norm(), options.step_max + 0.1 + 1e-12);
    for (const Leg other : kLegs) {
      const double least = other == leg ? 0.0 : 0.1;
      EXPECT_GE((step.goal - problem.feet[index(other)]).norm(), least);
    }
  }
}

}  // namespace
}  // namespace surefoot::gaits
