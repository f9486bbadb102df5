#include "tests/gaits/foothold_walker.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

using test::command;
using test::kCycle;
using test::Random;
using test::turned;

/// Feet of a stance that stands with its front feet `rise` above its hind feet, the last stride of
/// which led there over an edge; what its left front foot expects a stride further on.
struct OnTwoLevels {
  explicit OnTwoLevels(double rise, bool bounded = true)
      : planner({}, {.bounded_by_feet = bounded}) {
    for (const Leg leg : kLegs) {
      const double z = is_front(leg) ? rise : 0.0;
      feet[index(leg)] << nominal_offset({}, leg, kNumLegs), z;
      planner.remember(leg, feet[index(leg)] - Vec3(0.15, 0.0, z));
      planner.remember(leg, feet[index(leg)]);
    }
  }
  [[nodiscard]] double expected() const {
    const Vec2 place = feet[index(Leg::LF)].head<2>() + Vec2(0.2, 0.0);
    return planner.expected_height(Leg::LF, place, feet, estimation::fit_terrain_plane(feet, 0.35));
  }
  FootholdPlanner planner;
  PerLeg<Vec3> feet;
};

TEST(FootholdPlanner, BehindAnEdgeGroundIsExpectedNoHigherThanTheFeetStand) {
  for (const double rise : {0.2, 0.168, 0.14}) {
    EXPECT_NEAR(OnTwoLevels(rise).expected(), rise, 1e-12);
    EXPECT_GT(OnTwoLevels(rise, false).expected(), 1.2 * rise) << "the plane";
  }
}

TEST(FootholdPlanner, BehindAnEdgeSoIsThatOfAnotherPlaceThanOneWithoutGround) {
  OnTwoLevels feet(0.2);
  const estimation::TerrainPlane plane = estimation::fit_terrain_plane(feet.feet, 0.35);
  const auto next = [&] {
    return feet.planner.foothold(Leg::LF, feet.feet, plane, 0.0, command(0.04), kCycle);
  };
  const Vec3 first = next();
  feet.planner.avoid(first);
  const Vec3 other = next();
  EXPECT_GT((other - first).norm(), 0.0);
  EXPECT_GT(plane.height(other.head<2>()), 0.2);
  EXPECT_NEAR(other.z(), 0.2, 1e-12);
}

TEST(FootholdPlanner, BehindAnEdgeDownwardGroundIsExpectedOnThePlane) {
  for (const double rise : {-0.2, -0.14}) {
    EXPECT_EQ(OnTwoLevels(rise).expected(), OnTwoLevels(rise, false).expected());
  }
}

TEST(FootholdPlanner, OnASlopeInAnyDirectionGroundIsExpectedWhereItIs) {
  Random random(11);
  for (int trial = 0; trial < 50; ++trial) {
    const double yaw = random.uniform(-3.0, 3.0);
    const Vec2 slope = random.uniform(0.05, 0.35) * turned(random.uniform(-3.0, 3.0), {1.0, 0.0});
    const auto on_slope = [&](const Vec2& p) { return Vec3(p.x(), p.y(), slope.dot(p)); };
    FootholdPlanner planner({}, {});
    PerLeg<Vec3> feet;
    for (const Leg leg : kLegs) {
      const Vec2 place = turned(yaw, nominal_offset({}, leg, kNumLegs));
      planner.remember(leg, on_slope(place - turned(yaw, {0.12, 0.0})));
      feet[index(leg)] = on_slope(place);
      planner.remember(leg, feet[index(leg)]);
    }
    for (const Leg leg : kLegs) {
      const Vec2 next = feet[index(leg)].head<2>() + turned(yaw, {random.uniform(0.1, 0.3), 0.0});
      EXPECT_NEAR(
          planner.expected_height(leg, next, feet, estimation::fit_terrain_plane(feet, 0.35)),
          slope.dot(next), 1e-9)
          << trial;
    }
  }
}

}  // namespace
}  // namespace surefoot::gaits
