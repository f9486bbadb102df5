#include "surefoot/gaits/parts/swing_curve.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace surefoot::gaits {
namespace {

using test::Random;

constexpr int kTrials = 100;

/// Anywhere, the goal `rise` above the start along the terrain normal.
SwingTarget random_target(Random& random, double rise) {
  SwingTarget target;
  target.normal = random.small_rotation(0.25) * Vec3::UnitZ();
  const Vec3 across = random.vector(0.3);
  target.start = random.vector(5.0);
  target.goal =
      target.start + across - target.normal.dot(across) * target.normal + rise * target.normal;
  target.duration = random.uniform(0.3, 1.0);
  target.apex = random.uniform(0.03, 0.15);
  return target;
}

double rise(const SwingTarget& target) { return target.normal.dot(target.goal - target.start); }

/// Height over the start along the normal.
double height(const SwingTarget& target, const Vec3& p) {
  return target.normal.dot(p - target.start);
}

/// Share of the way from start to goal that was made within the plane.
double share(const SwingTarget& target, const Vec3& p) {
  const Vec3 way = target.goal - target.start - rise(target) * target.normal;
  return way.dot(p - target.start) / way.squaredNorm();
}

/// Calls check(curve, target, random) for steps on level ground, up and down.
template <typename Check>
void on_random_targets(unsigned seed, double least_rise, double largest_rise, const Check& check) {
  Random random(seed);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const SwingTarget target = random_target(random, random.uniform(least_rise, largest_rise));
    check(SwingCurve(target, SwingOptions{}), target, random);
  }
}

/// From the goal a curve searches straight down at the speed of a touchdown.
void expect_to_end_in_a_search(const SwingCurve& curve, const SwingTarget& target, double beyond) {
  const Vec3 down = -SwingOptions{}.touchdown_speed * target.normal;
  const Motion<Vec3> end = curve.at(target.duration), search = curve.at(target.duration + beyond);
  EXPECT_LT((end.p - target.goal).norm(), 1e-9);
  EXPECT_LT((end.v - down).norm(), 1e-9);
  EXPECT_LT(end.a.norm(), 1e-6);
  EXPECT_LT((search.p - (target.goal + beyond * down)).norm(), 1e-9);
  EXPECT_LT((search.v - down).norm(), 1e-9);
  EXPECT_LT(search.a.norm(), 1e-9);
}

TEST(SwingCurve, BeginsAtRestAtItsStartAndSearchesFromItsGoal) {
  on_random_targets(1, -0.3, 0.3,
                    [](const SwingCurve& curve, const SwingTarget& target, Random& random) {
                      const Motion<Vec3> begin = curve.at(0.0);
                      EXPECT_LT((begin.p - target.start).norm(), 1e-12);
                      EXPECT_LT(begin.v.norm(), 1e-12);
                      EXPECT_LT(begin.a.norm(), 1e-12);
                      EXPECT_EQ(curve.target().goal, target.goal);
                      expect_to_end_in_a_search(curve, target, random.uniform(0.001, 3.0));
                    });
}

TEST(SwingCurve, RisesToTheApexOverTheHigherOfStartAndGoal) {
  on_random_targets(3, -0.3, 0.3, [](const SwingCurve& curve, const SwingTarget& target, Random&) {
    double highest = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      highest = std::max(highest, height(target, curve.at(target.duration * i / 1000.0).p));
    }
    EXPECT_NEAR(highest, std::max(0.0, rise(target)) + target.apex, 1e-4 * highest);
  });
}

TEST(SwingCurve, VelocityAndAccelerationAreRates) {
  on_random_targets(4, -0.3, 0.3,
                    [](const SwingCurve& curve, const SwingTarget& target, Random& random) {
                      constexpr double kStep = 1e-6;
                      const double t = random.uniform(0.01, 1.5) * target.duration;
                      const Motion<Vec3> before = curve.at(t - kStep), after = curve.at(t + kStep);
                      const Motion<Vec3> now = curve.at(t);
                      EXPECT_LT(((after.p - before.p) / (2.0 * kStep) - now.v).norm(), 1e-4);
                      EXPECT_LT(((after.v - before.v) / (2.0 * kStep) - now.a).norm(), 1e-2);
                    });
}

TEST(SwingCurve, NeverJumpsInPositionVelocityOrAcceleration) {
  on_random_targets(5, -0.3, 0.3, [](const SwingCurve& curve, const SwingTarget& target, Random&) {
    constexpr double kStep = 1e-5;
    for (double t = 0.0; t < 1.3 * target.duration; t += kStep * target.duration * 37.0) {
      const Motion<Vec3> now = curve.at(t), next = curve.at(t + kStep * target.duration);
      ASSERT_LT((next.p - now.p).norm(), 1e-3);
      ASSERT_LT((next.v - now.v).norm(), 1e-2);
      ASSERT_LT((next.a - now.a).norm(), 0.5) << t / target.duration;
    }
  });
}

TEST(SwingCurve, OnLevelGroundMovesAlongTheGroundOnlyInItsWindow) {
  on_random_targets(
      6, -0.04, 0.04, [](const SwingCurve& curve, const SwingTarget& target, Random& random) {
        const SwingOptions options;
        const double T = target.duration;
        const double before = random.uniform(0.0, options.horizontal_start) * T;
        const double within = random.uniform(options.horizontal_start, options.horizontal_end) * T;
        const double after = random.uniform(options.horizontal_end, 2.0) * T;
        EXPECT_NEAR(share(target, curve.at(before).p), 0.0, 1e-9);
        EXPECT_GT(share(target, curve.at(within).p), 0.0);
        EXPECT_LT(share(target, curve.at(within).p), 1.0);
        EXPECT_NEAR(share(target, curve.at(after).p), 1.0, 1e-9);
      });
}

TEST(SwingCurve, UpstairsIsAboveTheGoalBeforeItMovesForward) {
  on_random_targets(7, 0.06, 0.3, [](const SwingCurve& curve, const SwingTarget& target, Random&) {
    for (int i = 0; i <= 200; ++i) {
      const Vec3 p = curve.at(target.duration * i / 200.0).p;
      const double least = share(target, p) > 1e-6 ? rise(target) : 0.0;
      ASSERT_GE(height(target, p), least - 1e-9) << i;
    }
  });
}

/// A foot in the air, in motion, that goes straight to its goal.
SwingTarget random_straight_target(Random& random) {
  SwingTarget target = random_target(random, random.uniform(-0.3, 0.0));
  target.straight = true;
  target.velocity = random.vector(2.0);
  target.duration = random.uniform(0.1, 0.4);
  return target;
}

TEST(SwingCurve, AStraightOneGoesOnWithTheVelocityOfItsFootAndSearchesFromItsGoal) {
  Random random(12);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const SwingTarget target = random_straight_target(random);
    const SwingCurve curve(target, SwingOptions{});
    const Motion<Vec3> begin = curve.at(0.0);
    EXPECT_LT((begin.p - target.start).norm(), 1e-12);
    EXPECT_LT((begin.v - target.velocity).norm(), 1e-12);
    EXPECT_LT(begin.a.norm(), 1e-12);
    expect_to_end_in_a_search(curve, target, random.uniform(0.001, 3.0));
  }
}

TEST(SwingCurve, AStraightOneHasRatesOnItsWay) {
  Random random(13);
  constexpr double kStep = 1e-6;
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const SwingTarget target = random_straight_target(random);
    const SwingCurve curve(target, SwingOptions{});
    const double t = random.uniform(0.01, 1.5) * target.duration;
    const Motion<Vec3> before = curve.at(t - kStep), now = curve.at(t), after = curve.at(t + kStep);
    EXPECT_LT(((after.p - before.p) / (2.0 * kStep) - now.v).norm(), 1e-4);
    EXPECT_LT(((after.v - before.v) / (2.0 * kStep) - now.a).norm(), 1e-2);
  }
}

TEST(SwingCurve, KnowsItsGreatestAcceleration) {
  Random random(14);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const SwingTarget target =
        trial % 2 == 0 ? random_straight_target(random) : random_target(random, 0.1);
    const SwingCurve curve(target, SwingOptions{});
    double greatest = 0.0;
    for (int i = 0; i <= 5000; ++i)
      greatest = std::max(greatest, curve.at(target.duration * i / 5000.0).a.norm());
    EXPECT_NEAR(curve.peak_acceleration(), greatest, 0.02 * greatest);
  }
}

TEST(SwingCurve, TurnsAndMovesWithTheWorld) {
  on_random_targets(10, -0.3, 0.3,
                    [](const SwingCurve& curve, const SwingTarget& target, Random& random) {
                      const Quat R = random.rotation();
                      const Vec3 shift = random.vector(10.0);
                      SwingTarget moved = target;
                      moved.start = R * target.start + shift;
                      moved.goal = R * target.goal + shift;
                      moved.normal = R * target.normal;
                      const SwingCurve there(moved, SwingOptions{});
                      const double t = random.uniform(0.0, 1.5) * target.duration;
                      EXPECT_LT((R * curve.at(t).p + shift - there.at(t).p).norm(), 1e-9);
                      EXPECT_LT((R * curve.at(t).v - there.at(t).v).norm(), 1e-9);
                      EXPECT_LT((R * curve.at(t).a - there.at(t).a).norm(), 1e-7);
                    });
}

TEST(SwingCurve, HasAWindowToMoveInWhateverTheOptionsAndTheStep) {
  Random random(11);
  for (int trial = 0; trial < kTrials; ++trial) {
    SwingOptions options;
    options.horizontal_start = random.uniform(0.0, 0.9);
    options.horizontal_end = random.uniform(options.horizontal_start + 0.05, 1.0);
    const SwingTarget target = random_target(random, random.uniform(-0.3, 0.3));
    const SwingCurve curve(target, options);
    const double length = (target.goal - target.start).norm();
    for (int i = 0; i < 1000; ++i) {
      const Vec3 step =
          curve.at(target.duration * (i + 1) / 1000.0).p - curve.at(target.duration * i / 1000.0).p;
      ASSERT_LT(step.norm(), 0.06 * length + 0.005) << "trial " << trial << " at " << i;
    }
    EXPECT_LT((curve.at(target.duration).p - target.goal).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::gaits
