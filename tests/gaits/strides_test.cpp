#include "surefoot/gaits/parts/strides.hpp"

#include "tests/gaits/foothold_walker.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::gaits {
namespace {

const FootholdOptions kWithoutPrints{.hind_use_front_prints = false};

const PerLeg<Vec2> kHips{Vec2(0.3, 0.2), Vec2(0.3, -0.2), Vec2(-0.3, 0.2), Vec2(-0.3, -0.2)};

Strides strides(const FootholdOptions& foothold = {}, const SwingOptions& swing = {}) {
  PlannerOptions options;
  options.stance = {.half_length = 0.3, .half_width = 0.2};
  options.gait.swing_duration = 1.0;
  options.swing = swing;
  options.foothold = foothold;
  return Strides(options);
}

/// `reach` of the legs along the ground, `length` that a swing can do in its time [m].
double share(const UserCommand& user, const FootholdOptions& options, double reach = 1.0,
             double length = 1.0) {
  return strides(options, {.reach_max = reach, .speed_max = length})
      .feasible_share(user, kHips, 0.0, test::kCycle);
}

TEST(Strides, KeepsACommandWhoseStridesTheLegsHave) {
  EXPECT_EQ(share(test::command(0.0), {}), 1.0);
  EXPECT_EQ(share(test::command(0.07), {.max_step = 0.30}), 1.0);
  EXPECT_EQ(share(test::command(0.0, 0.05), {.max_side_step = 0.22}), 1.0);
  EXPECT_EQ(share(test::command(0.0, 0.0, 0.1), {}), 1.0);
}

TEST(Strides, SlowsToTheLongestStride) {
  for (const double forward : {0.15, -0.15, 100.0}) {
    const double stride = test::kCycle * std::abs(forward);
    EXPECT_NEAR(share(test::command(forward), {.max_step = 0.30}) * stride, 0.30, 1e-12);
    EXPECT_NEAR(share(test::command(forward), {.max_step = 0.30, .max_stride = 0.25}) * stride,
                0.25, 1e-12);
    // About feet that stand below their hips: half of the stride to either side.
    EXPECT_NEAR(share(test::command(forward), {.max_step = 0.30}, 0.1, 1.0) * stride, 0.20, 1e-12);
    EXPECT_NEAR(share(test::command(forward), {.max_step = 0.30}, 1.0, 0.1) * stride, 0.10, 1e-12);
  }
}

TEST(Strides, SlowsSidewaysAndTurningStridesMore) {
  EXPECT_NEAR(share(test::command(0.0, 0.2), {.max_side_stride = 0.05}) * 0.2 * test::kCycle, 0.05,
              1e-12);
  const FootholdOptions options{.max_step = 0.30, .max_side_step = 0.10};
  EXPECT_NEAR(share(test::command(0.0, 1.0), options) * test::kCycle, 0.10, 1e-12);
  EXPECT_LT(share(test::command(0.07, 0.02), options), 1.0);
  const double turning = share(test::command(0.0, 0.0, 1.0), options) * test::kCycle;
  EXPECT_NEAR(std::hypot(0.2 * turning / 0.30, 0.3 * turning / 0.10), 1.0, 1e-12);
}

double tallest(const UserCommand& user) {
  return strides({}, {.reach_max = 0.56}).tallest(user, kHips, test::kCycle);
}

TEST(Strides, LongerStridesLeaveLessHeightToTheLegs) {
  EXPECT_LT(tallest(test::command(0.0)), 0.55);
  EXPECT_GT(tallest(test::command(0.0)), 0.5);
  for (const UserCommand& user : {test::command(0.05), test::command(-0.05),
                                  test::command(0.0, 0.05), test::command(0.0, 0.0, 0.1)})
    EXPECT_LT(tallest(user), tallest(test::command(0.0)) - 0.005);
  EXPECT_LT(tallest(test::command(0.0, 0.05)), tallest(test::command(0.05))) << "beside the sway";
  EXPECT_EQ(tallest(test::command(1.0)), 0.0);
}

double turning(const test::Walker& walker, double yaw_rate,
               const PerLeg<bool>& down = {true, true, true, true}) {
  PlannerOptions options;
  options.stance = walker.stance;
  return Strides(options).turning_share(yaw_rate, walker.feet, down, walker.yaw, test::kCycle);
}

TEST(Strides, AHeadingThatRunsAheadOfTheFeetWaitsForThem) {
  test::Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    test::Walker walker(kWithoutPrints);
    walker.stand(random.vector(10.0).head<2>(), random.uniform(-3.0, 3.0));
    for (const double yaw_rate : {0.2, -0.2}) {
      EXPECT_EQ(turning(walker, yaw_rate), 1.0);
      const double heading = walker.yaw;
      walker.yaw += yaw_rate * 0.10 * test::kCycle;
      EXPECT_EQ(turning(walker, yaw_rate), 1.0);
      walker.yaw += yaw_rate * 0.12 * test::kCycle;
      EXPECT_GT(turning(walker, yaw_rate), 0.0);
      EXPECT_LT(turning(walker, yaw_rate), 1.0);
      EXPECT_EQ(turning(walker, -yaw_rate), 1.0) << "back to them";
      walker.yaw += yaw_rate * 0.10 * test::kCycle;
      EXPECT_EQ(turning(walker, yaw_rate), 0.0);
      walker.yaw = heading;
    }
  }
}

TEST(Strides, AFootThatIsLeftBehindHoldsTheTurnUpUntilItIsLifted) {
  test::Walker walker(kWithoutPrints);
  for (const Leg leg : kLegs) {
    for (const double yaw_rate : {0.05, -0.05}) {
      walker.stand({1.0, 2.0}, 0.7);
      const double way = is_front(leg) == (yaw_rate > 0.0) ? -0.18 : 0.18;
      walker.feet[index(leg)].head<2>() += test::turned(walker.yaw, Vec2(0.0, way));
      EXPECT_EQ(turning(walker, yaw_rate), 0.0) << kLegNames[index(leg)];
      PerLeg<bool> down{true, true, true, true};
      down[index(leg)] = false;
      EXPECT_GT(turning(walker, yaw_rate, down), 0.5) << kLegNames[index(leg)];
      EXPECT_EQ(turning(walker, -yaw_rate), 1.0) << kLegNames[index(leg)];
    }
  }
}

TEST(Strides, StridesHoldNoTurnUp) {
  test::Walker walker(kWithoutPrints);
  walker.stand({1.0, 2.0}, 0.7);
  walker.walk(8, test::command(0.075));
  for (int i = 0; i < 8; ++i) {
    walker.step(test::command(0.075));
    for (const double yaw_rate : {0.05, -0.05}) EXPECT_EQ(turning(walker, yaw_rate), 1.0);
  }
}

TEST(Strides, ASteadyTurnHoldsItselfUpByLittle) {
  for (const double yaw_rate : {0.1, -0.1}) {
    test::Walker walker(kWithoutPrints);
    walker.stand({1.0, 2.0}, 0.7);
    walker.walk(8, test::command(0.0, 0.0, yaw_rate));
    for (int i = 0; i < 8; ++i) {
      walker.step(test::command(0.0, 0.0, yaw_rate));
      EXPECT_GT(turning(walker, yaw_rate), 0.5) << i;
    }
  }
}

TEST(Strides, AHipOutOfReachAllowsNoStride) {
  EXPECT_EQ(share(test::command(0.1), {}, 0.0, 1.0), 0.0);
}

}  // namespace
}  // namespace surefoot::gaits
