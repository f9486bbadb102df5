#include "surefoot/view/ground.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::report {
namespace {

LogTerrain box(const Vec3& position, const Vec3& size, double pitch = 0.0) {
  return {.shape = "box",
          .position = position,
          .q_WT = Quat(Eigen::AngleAxisd(pitch, Vec3::UnitY())),
          .size = size};
}

TEST(Ground, OfABoxIsItsTopAndNothingBesideIt) {
  const Ground ground({box({1.0, 0.0, 0.1}, {2.0, 1.0, 0.2})});
  EXPECT_NEAR(ground.at({0.5, 0.4}).z, 0.2, 1e-12);
  EXPECT_EQ(ground.at({0.5, 0.6}).face, -1);
  EXPECT_TRUE(std::isnan(ground.at({-0.1, 0.0}).z));
}

TEST(Ground, TheHighestPieceCounts) {
  LogTerrain plane;
  plane.shape = "plane";
  const Ground ground(
      {plane, box({0.0, 0.0, 0.0}, {1.0, 1.0, 0.3}), box({5.0, 0.0, -1.0}, {1.0, 1.0, 0.3})});
  EXPECT_NEAR(ground.at({0.0, 0.0}).z, 0.15, 1e-12);
  EXPECT_NEAR(ground.at({2.0, 0.0}).z, 0.0, 1e-12);
  EXPECT_NEAR(ground.at({5.0, 0.0}).z, 0.0, 1e-12) << "the second box lies below the plane";
  EXPECT_NE(ground.at({0.0, 0.0}).face, ground.at({2.0, 0.0}).face);
}

TEST(Ground, ATiltedBoxSlopesAndEndsWhereItsEdgeIs) {
  const double pitch = -0.3;  // rises ahead
  const Ground ground({box({0.0, 0.0, 0.0}, {2.0, 2.0, 0.4}, pitch)});
  const GroundPoint here = ground.at({0.1, 0.0});
  EXPECT_NEAR(here.slope.x(), std::tan(0.3), 1e-12);
  EXPECT_NEAR(here.z, 0.2 / std::cos(0.3) + 0.1 * std::tan(0.3), 1e-12);
  // Its right upper edge at (1, 0.2) of the box, its lower one at (1, −0.2).
  EXPECT_EQ(ground.at({std::cos(0.3) - 0.2 * std::sin(0.3) - 1e-3, 0.0}).face, here.face);
  EXPECT_NE(ground.at({std::cos(0.3) - 0.2 * std::sin(0.3) + 1e-3, 0.0}).face, here.face);
  EXPECT_EQ(ground.at({std::cos(0.3) + 0.2 * std::sin(0.3) + 1e-3, 0.0}).face, -1);
}

TEST(Ground, BetweenTheHeightsOfAGridIsInterpolated) {
  LogTerrain grid{.shape = "heights", .position = {1.0, 0.0, 0.5}, .size = {2.0, 1.0, 0.0}};
  grid.columns = 3;
  grid.rows = 2;
  grid.heights = {0.0, 0.1, 0.2, 1.0, 1.1, 1.2};
  const Ground ground({grid});
  EXPECT_NEAR(ground.at({0.5, -0.5}).z, 0.55, 1e-12);
  EXPECT_NEAR(ground.at({1.0, 0.0}).z, 1.1, 1e-12);
  EXPECT_NEAR(ground.at({1.5, 0.0}).slope.x(), 0.1, 1e-12);
  EXPECT_EQ(ground.at({1.0, 0.51}).face, -1);
}

}  // namespace
}  // namespace surefoot::report
