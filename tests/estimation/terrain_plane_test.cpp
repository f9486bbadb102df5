#include "surefoot/estimation/terrain_plane.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kMaxTilt = 0.5;  // [rad]
constexpr int kTrials = 200;

/// Four feet in a stance of random shape on the plane through `point`.
PerLeg<Vec3> feet_on(const Vec3& normal, const Vec3& point, Random& random) {
  PerLeg<Vec3> feet;
  for (const Leg leg : kLegs) {
    Vec3 d(is_front(leg) ? 0.36 : -0.36, is_left(leg) ? 0.22 : -0.22, 0.0);
    d += random.vector(0.1);
    d.z() = -(normal.x() * d.x() + normal.y() * d.y()) / normal.z();
    feet[index(leg)] = point + d;
  }
  return feet;
}

TEST(TerrainPlane, OfFeetInAPlaneIsThatPlane) {
  Random random(1);
  for (int trial = 0; trial < kTrials; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    const Vec3 normal = random.small_rotation(0.25) * Vec3::UnitZ();
    const PerLeg<Vec3> feet = feet_on(normal, random.vector(5.0), random);
    const TerrainPlane plane = fit_terrain_plane(feet, kMaxTilt);
    EXPECT_LT((plane.normal - normal).norm(), 1e-9);
    EXPECT_LT((plane.point - 0.25 * (feet[0] + feet[1] + feet[2] + feet[3])).norm(), 1e-12);
    for (const Vec3& p : feet) EXPECT_NEAR(plane.height(p.head<2>()), p.z(), 1e-9);
  }
}

TEST(TerrainPlane, HasTheLeastSquaresOfHeightsOfAllPlanes) {
  Random random(2);
  const auto squares = [](const PerLeg<Vec3>& feet, const TerrainPlane& plane) {
    double sum = 0.0;
    for (const Vec3& p : feet) sum += std::pow(p.z() - plane.height(p.head<2>()), 2);
    return sum;
  };
  for (int trial = 0; trial < kTrials; ++trial) {
    PerLeg<Vec3> feet = feet_on(Vec3::UnitZ(), random.vector(1.0), random);
    for (Vec3& p : feet) p.z() += random.uniform(-0.05, 0.05);
    const TerrainPlane plane = fit_terrain_plane(feet, kMaxTilt);
    TerrainPlane other = plane;
    other.normal = random.small_rotation(0.02) * plane.normal;
    other.point.z() += random.uniform(-0.01, 0.01);
    EXPECT_LE(squares(feet, plane), squares(feet, other) + 1e-15) << trial;
  }
}

TEST(TerrainPlane, OfFeetTwistedAgainstEachOtherIsLevel) {
  const PerLeg<Vec3> feet{Vec3(0.36, 0.22, 0.02), Vec3(0.36, -0.22, -0.02),
                          Vec3(-0.36, 0.22, -0.02), Vec3(-0.36, -0.22, 0.02)};
  const TerrainPlane plane = fit_terrain_plane(feet, kMaxTilt);
  EXPECT_LT((plane.normal - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(TerrainPlane, OfFeetInOnePlaceIsLevel) {
  const Vec3 p(3.0, -2.0, 0.5);
  PerLeg<Vec3> feet{p, p, p, p};
  EXPECT_EQ(fit_terrain_plane(feet, kMaxTilt).normal, Vec3::UnitZ());
  feet[0].z() += 0.1;  // one above the other: the slope is unknown
  EXPECT_EQ(fit_terrain_plane(feet, kMaxTilt).normal, Vec3::UnitZ());
}

TEST(TerrainPlane, OfFeetInALineIsLevelAcrossIt) {
  Random random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const double angle = random.uniform(-3.0, 3.0), slope = random.uniform(-0.4, 0.4);
    const Vec3 along(std::cos(angle), std::sin(angle), slope);
    const Vec3 across(-std::sin(angle), std::cos(angle), 0.0);
    PerLeg<Vec3> feet;
    const Vec3 origin = random.vector(3.0);
    for (std::size_t k = 0; k < feet.size(); ++k) {
      feet[k] = origin + (0.2 * static_cast<double>(k) - 0.3) * along;
      feet[k] += random.uniform(-1e-3, 1e-3) * across;
      feet[k].z() += random.uniform(-1e-4, 1e-4);
    }
    const TerrainPlane plane = fit_terrain_plane(feet, kMaxTilt);
    EXPECT_NEAR(plane.normal.dot(across), 0.0, 1e-2);
    EXPECT_NEAR(plane.normal.dot(along.normalized()), 0.0, 1e-3);
  }
}

TEST(TerrainPlane, IsNeverTiltedFurtherThanAllowed) {
  Random random(4);
  for (int trial = 0; trial < kTrials; ++trial) {
    PerLeg<Vec3> feet = feet_on(Vec3::UnitZ(), Vec3::Zero(), random);
    for (Vec3& p : feet) p.z() = random.uniform(-2.0, 2.0);
    const TerrainPlane plane = fit_terrain_plane(feet, kMaxTilt);
    ASSERT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    ASSERT_LE(std::acos(plane.normal.z()), kMaxTilt + 1e-9);
  }
}

TEST(TerrainPlane, KeepsTheDirectionOfASlopeThatIsTooSteep) {
  Random random(5);
  const Vec3 steep = Vec3(-1.0, -2.0, 1.0).normalized();
  const TerrainPlane plane = fit_terrain_plane(feet_on(steep, Vec3::Zero(), random), kMaxTilt);
  EXPECT_NEAR(std::acos(plane.normal.z()), kMaxTilt, 1e-9);
  EXPECT_NEAR(plane.normal.y() / plane.normal.x(), 2.0, 1e-9);
}

TEST(ControlFrame, IsARightHandedFrameAlongTheNormalAndTheHeading) {
  Random random(7);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Vec3 normal = random.small_rotation(0.6) * Vec3::UnitZ();
    const double yaw = random.uniform(-kPi, kPi);
    const Mat3 R = control_frame(normal, yaw);
    EXPECT_LT((R.transpose() * R - Mat3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
    EXPECT_LT((R.col(2) - normal).norm(), 1e-12);
    const Vec3 heading(std::cos(yaw), std::sin(yaw), 0.0);
    const Vec3 on_plane = heading - normal.dot(heading) * normal;
    EXPECT_LT((R.col(0) - on_plane.normalized()).norm(), 1e-12);
  }
}

TEST(ControlFrame, OnLevelGroundIsATurnAboutTheVertical) {
  EXPECT_LT((control_frame(Vec3::UnitZ(), 0.7) - rotation_about_z(0.7)).norm(), 1e-15);
}

TEST(TerrainPlane, OfASmallRobotsFeetHasASlopeWhereALargeOnesNearlyCoincide) {
  PerLeg<Vec3> feet;
  for (const Leg leg : kLegs) {
    const double x = is_front(leg) ? 0.006 : -0.006;
    feet[index(leg)] = Vec3(x, is_left(leg) ? 0.22 : -0.22, 0.2 * x);
  }
  EXPECT_NEAR(fit_terrain_plane(feet, kMaxTilt).normal.x(), 0.0, 1e-12);
  const Vec3 normal = fit_terrain_plane(feet, kMaxTilt, {.length = 0.5}).normal;
  EXPECT_NEAR(normal.x() / normal.z(), -0.2, 1e-9);
}

}  // namespace
}  // namespace surefoot::estimation
