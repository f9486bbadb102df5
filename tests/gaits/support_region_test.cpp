#include "surefoot/gaits/parts/support_region.hpp"

#include "surefoot/math/numbers.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace surefoot::gaits {
namespace {

using test::RandomMatrices;

constexpr int kTrials = 300;

using Feet = PerLeg<Vec2>;
using Shares = PerLeg<double>;

Feet random_stance(RandomMatrices& random) {
  Feet feet;
  for (const Leg leg : kLegs) {
    feet[index(leg)] = Vec2(is_front(leg) ? 0.36 : -0.36, is_left(leg) ? 0.22 : -0.22) +
                       Vec2(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15));
  }
  return feet;
}

Shares random_shares(RandomMatrices& random) {
  Shares shares;
  for (double& share : shares) share = random.uniform(0.3, 1.2);
  return shares;
}

/// Where the lines that halve a triangle's angles meet.
Vec2 incenter(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double to_a = (b - c).norm(), to_b = (a - c).norm(), to_c = (a - b).norm();
  return (to_a * a + to_b * b + to_c * c) / (to_a + to_b + to_c);
}

Vec2 random_point(RandomMatrices& random) {
  return {random.uniform(-0.6, 0.6), random.uniform(-0.5, 0.5)};
}

/// Σ w_i p_i at all vertices of { 0 ≤ w_i ≤ α_i, Σ w_i = 1 }: every foot but one takes all or
/// nothing.
std::vector<Vec2> extreme_points(const Feet& feet, const Shares& shares) {
  std::vector<Vec2> points;
  for (unsigned full = 0; full < 16; ++full) {
    for (unsigned rest = 0; rest < kNumLegs; ++rest) {
      double left = 1.0;
      Vec2 sum = Vec2::Zero();
      for (unsigned k = 0; k < kNumLegs; ++k) {
        const bool takes_all = k != rest && ((full >> k) & 1u) != 0u;
        left -= takes_all ? shares[k] : 0.0;
        sum += takes_all ? Vec2(shares[k] * feet[k]) : Vec2::Zero();
      }
      const bool possible = left >= 0.0 && left <= shares[rest];
      if (possible) points.emplace_back(sum + left * feet[rest]);
    }
  }
  return points;
}

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Smallest distance of q to a line through two of the points that has all of them on its left.
double hull_margin(const std::vector<Vec2>& points, const Vec2& q) {
  double smallest = kInfinity;
  for (const Vec2& a : points) {
    for (const Vec2& b : points) {
      if ((b - a).norm() < 1e-7) continue;
      const Vec2 along = (b - a).normalized();
      const bool outer =
          std::ranges::all_of(points, [&](const Vec2& p) { return cross(along, p - a) > -1e-10; });
      if (outer) smallest = std::min(smallest, cross(along, q - a));
    }
  }
  return smallest;
}

double support(const std::vector<Vec2>& points, const Vec2& normal) {
  double largest = -kInfinity;
  for (const Vec2& p : points) largest = std::max(largest, normal.dot(p));
  return largest;
}

TEST(SupportRegion, IsTheHullOfAllDistributionsOfTheWeight) {
  RandomMatrices random(3);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    const Shares any = random_shares(random), all{1.0, 1.0, 1.0, 1.0};
    Shares without_one = all;
    without_one[static_cast<std::size_t>(random.integer(0, 3))] = 0.0;
    const Vec2 q = random_point(random);
    for (const Shares& shares : {any, all, without_one}) {
      ASSERT_NEAR(SupportRegion(feet, shares).margin(q),
                  hull_margin(extreme_points(feet, shares), q), 1e-7)
          << trial;
    }
  }
}

TEST(SupportRegion, EveryEdgeTouchesTheRegionFromOutside) {
  RandomMatrices random(4);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    const Shares shares = random_shares(random);
    const SupportRegion region(feet, shares);
    const std::vector<Vec2> points = extreme_points(feet, shares);
    ASSERT_GE(region.num_edges(), 3);
    for (int i = 0; i < region.num_edges(); ++i) {
      ASSERT_NEAR(region.edge(i).normal.norm(), 1.0, 1e-12);
      ASSERT_NEAR(region.edge(i).offset, support(points, region.edge(i).normal), 1e-9);
    }
  }
}

TEST(SupportRegion, HoldsEveryDistributionOfTheWeightThatItsSharesAllow) {
  RandomMatrices random(5);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    Shares w, shares;
    double sum = 0.0;
    for (double& weight : w) sum += weight = random.uniform(0.0, 1.0);
    Vec2 p = Vec2::Zero();
    for (std::size_t k = 0; k < feet.size(); ++k) {
      p += w[k] / sum * feet[k];
      shares[k] = w[k] / sum + random.uniform(0.0, 0.4);
    }
    ASSERT_GE(SupportRegion(feet, shares).margin(p), -1e-12) << trial;
  }
}

TEST(SupportRegion, ShrinksSteadilyToTheTriangleAsOneFootIsUnloaded) {
  RandomMatrices random(6);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    const auto foot = static_cast<std::size_t>(random.integer(0, 3));
    Vec2 center = Vec2::Zero();
    for (const Vec2& p : feet) center += 0.25 * p;
    const Vec2 q = center + 0.3 * (random_point(random) - center);
    Shares shares{0.9, 0.9, 0.9, 0.9};
    double before = SupportRegion(feet, shares).margin(q);
    for (double share = 0.9; share > 1e-7; share *= 0.7) {
      shares[foot] = share;
      const double margin = SupportRegion(feet, shares).margin(q);
      ASSERT_LE(margin, before + 1e-9) << "trial " << trial << ", share " << share;
      before = margin;
    }
    shares[foot] = 0.0;
    ASSERT_NEAR(before, SupportRegion(feet, shares).margin(q), 1e-6) << trial;
  }
}

TEST(SupportRegion, OfTwoFeetIsTheSegmentBetweenThem) {
  RandomMatrices random(7);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    const SupportRegion region(feet, {1.0, 0.0, 0.0, 1.0});
    const Vec2 a = feet[0], b = feet[3];
    const Vec2 along = (b - a).normalized();
    const Vec2 across(-along.y(), along.x());
    const Vec2 between = a + random.uniform(0.0, 1.0) * (b - a);
    const double off = random.uniform(0.01, 0.2);
    ASSERT_NEAR(region.margin(between), 0.0, 1e-9);
    ASSERT_NEAR(region.margin(between + off * across), -off, 1e-9);
    ASSERT_NEAR(region.margin(between - off * across), -off, 1e-9);
    ASSERT_NEAR(region.margin(b + off * along), -off, 1e-9);
    ASSERT_NEAR(region.margin(a - off * along), -off, 1e-9);
  }
}

TEST(SupportRegion, OfTwoFeetThatCanCarryPartOfTheWeightIsTheMiddleOfTheSegment) {
  const Feet feet{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(5.0, 5.0), Vec2(5.0, 6.0)};
  const SupportRegion region(feet, {0.7, 0.8, 0.0, 0.0});
  EXPECT_NEAR(region.margin({0.3, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(region.margin({0.8, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(region.margin({0.2, 0.0}), -0.1, 1e-12);
  EXPECT_NEAR(region.margin({0.9, 0.0}), -0.1, 1e-12);
}

TEST(SupportRegion, OfFeetThatCannotCarryTheWeightHasTheirSharesScaledUp) {
  const Feet feet{Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(5.0, 6.0)};
  const SupportRegion region(feet, {0.2, 0.2, 0.1, 0.0});
  EXPECT_GE(region.margin({0.4, 0.2}), 0.0);   // loaded by 0.4, 0.4, 0.2 of the weight
  EXPECT_LT(region.margin({0.45, 0.2}), 0.0);  // 2 % is all that they can carry more
  EXPECT_LT(region.margin({0.4, 0.25}), 0.0);
}

TEST(SupportRegion, OfOneFootIsItsPoint) {
  const Feet feet{Vec2(0.1, 0.2), Vec2(1.0, 0.0), Vec2(0.0, 1.0), Vec2(5.0, 6.0)};
  const SupportRegion region(feet, {0.8, 0.0, 0.0, 0.0});
  EXPECT_NEAR(region.margin(feet[0]), 0.0, 1e-12);
  const Vec2 inward = (Vec2(6.1, 7.2) / 4.0 - feet[0]).normalized();
  const Vec2 across(-inward.y(), inward.x());
  for (const Vec2& off : {inward, across}) {
    EXPECT_NEAR(region.margin(feet[0] + 0.1 * off), -0.1, 1e-12);
    EXPECT_NEAR(region.margin(feet[0] - 0.1 * off), -0.1, 1e-12);
  }
}

TEST(SupportRegion, TurnsWithTheFeet) {
  RandomMatrices random(8);
  for (int trial = 0; trial < 200; ++trial) {
    const Feet feet = random_stance(random);
    Shares shares{};
    for (double& share : shares) share = random.chance(0.5) ? 1.0 : 0.0;
    if (shares == Shares{}) continue;
    const Eigen::Rotation2Dd turn(random.uniform(-3.0, 3.0));
    Feet turned;
    for (std::size_t k = 0; k < kNumLegs; ++k) turned[k] = turn * feet[k];
    const Vec2 p = random_point(random);
    EXPECT_NEAR(SupportRegion(turned, shares).margin(turn * p),
                SupportRegion(feet, shares).margin(p), 1e-12);
  }
}

TEST(SupportRegion, OfCoincidentFeetIsThatOfOneFoot) {
  const Vec2 p(0.1, -0.3);
  const SupportRegion region({p, p, p, p}, {1.0, 1.0, 1.0, 1.0});
  EXPECT_NEAR(region.margin(p), 0.0, 1e-12);
  EXPECT_NEAR(region.margin(p + Vec2(0.0, 0.2)), -0.2, 1e-12);
}

TEST(SupportRegion, OfFeetInALineIsTheSegmentFromEndToEnd) {
  const Vec2 along = Vec2(0.6, 0.8);
  const Feet in_a_row{-0.5 * along, 0.1 * along, 0.3 * along, 0.5 * along};
  const Feet one_twice{-0.5 * along, 0.5 * along, 0.5 * along, Vec2(7.0, 7.0)};
  for (const SupportRegion& region : {SupportRegion(in_a_row, {1.0, 1.0, 1.0, 1.0}),
                                      SupportRegion(one_twice, {1.0, 1.0, 1.0, 0.0})}) {
    EXPECT_NEAR(region.margin(0.4 * along), 0.0, 1e-12);
    EXPECT_NEAR(region.margin(0.7 * along), -0.2, 1e-12);
    EXPECT_NEAR(region.margin(-0.7 * along), -0.2, 1e-12);
    EXPECT_NEAR(region.margin(Vec2(0.8, -0.6) * 0.2), -0.2, 1e-12);
  }
}

TEST(SupportRegion, OfTwoFeetInOnePlaceAndTwoOthersIsATriangle) {
  const Feet feet{Vec2(0.0, 0.0), Vec2(0.0, 0.0), Vec2(1.0, 0.0), Vec2(0.0, 1.0)};
  const SupportRegion region(feet, {1.0, 1.0, 1.0, 1.0});
  EXPECT_NEAR(region.margin({0.2, 0.3}), 0.2, 1e-12);
  EXPECT_NEAR(region.margin({0.6, 0.6}), -0.2 / std::sqrt(2.0), 1e-12);
}

TEST(SupportRegion, InradiusIsTheMarginOfTheTrianglesCenter) {
  RandomMatrices random(31);
  for (int trial = 0; trial < kTrials; ++trial) {
    const Feet feet = random_stance(random);
    for (const Leg lifted : kLegs) {
      Shares shares{1.0, 1.0, 1.0, 1.0};
      shares[index(lifted)] = 0.0;
      std::vector<Vec2> corners;
      for (const Leg leg : kLegs) {
        if (leg != lifted) corners.push_back(feet[index(leg)]);
      }
      const Vec2 center = incenter(corners[0], corners[1], corners[2]);
      EXPECT_NEAR(inradius_without(lifted, feet), SupportRegion(feet, shares).margin(center),
                  1e-12);
    }
  }
  const Vec2 p(0.1, -0.3);
  EXPECT_EQ(inradius_without(Leg::LF, {Vec2(5.0, 5.0), p, p, p}), 0.0);
}

TEST(SupportRegion, WithNoFootDownHasNothingInside) {
  const SupportRegion region({Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}, {0, 0, 0, 0});
  EXPECT_EQ(region.num_edges(), 0);
  EXPECT_EQ(region.margin({0.5, 0.5}), -kInfinity);
  EXPECT_EQ(SupportRegion().margin({0.5, 0.5}), -kInfinity);
}

}  // namespace
}  // namespace surefoot::gaits
