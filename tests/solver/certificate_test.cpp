#include "surefoot/solver/certificate.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

VectorXd number(double b) { return VectorXd::Constant(1, b); }

/// Three random levels, and a last one that leaves no choice.
HierarchyData levels_with_one_optimum(RandomMatrices& random) {
  HierarchyData levels = random_levels(random, {.unknowns = 6, .levels = 3, .max_rows = 3});
  levels.push_back(close_to(random.vector(6)));
  return levels;
}

TEST(Certificate, AcceptsTheOptimumAndRefusesWhatIsBesideIt) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = levels_with_one_optimum(random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), 1e-10);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-6);
  }
}

TEST(Certificate, RefusesALowerLevelThatWasServedFirst) {
  const HierarchyData levels{equalities(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(3.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 1e-15);
  EXPECT_GE(optimality_error(2, levels, Vector2d(3.0, 0.0)), 0.1);
  EXPECT_GE(optimality_error(2, levels, Vector2d(2.0, 0.0)), 0.1);
}

TEST(Certificate, RefusesALimitThatHoldsWithoutNeed) {
  // x = 1 touches the limit x ≤ 1, but the task x = 0 leads away from it.
  const HierarchyData levels{at_most(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(0.0))};
  EXPECT_GE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 0.1);
  EXPECT_LE(optimality_error(2, levels, Vector2d(0.0, 0.0)), 1e-15);
}

TEST(Certificate, GivesTheResidualOfEachLevel) {
  const HierarchyData levels{at_most(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(MatrixXd::Identity(2, 2), Vector2d(0.0, 7.0))};
  const auto certificates = certify(make_hierarchy(2, levels), Vector2d(4.0, 3.0));
  EXPECT_EQ(certificates[0].residual, 3.0);
  EXPECT_NEAR(certificates[1].residual, std::sqrt(32.0), 1e-15);
}

/// The same wishes in other units.
HierarchyData in_other_units(HierarchyData levels, RandomMatrices& random) {
  for (LevelData& level : levels) {
    const double unit = std::pow(10.0, random.integer(-6, 6));
    level.A *= unit;
    level.lower *= unit;
    level.upper *= unit;
  }
  return levels;
}

TEST(Certificate, DoesNotDependOnTheUnitsOfLevels) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = levels_with_one_optimum(random);
    const VectorXd x = solve(6, levels).x;
    const HierarchyData scaled = in_other_units(levels, random);
    const VectorXd beside = x + 1e-3 * random.vector(6);
    ASSERT_LE(optimality_error(6, scaled, x), 1e-9);
    ASSERT_NEAR(optimality_error(6, scaled, beside) / optimality_error(6, levels, beside), 1.0,
                1e-5);
  }
}

TEST(Certificate, RefusesAShortRowThatIsNotServed) {
  for (const double length : {1e-12, 1e-8, 1e-5, 1.0, 1e6}) {
    const HierarchyData levels{equalities(MatrixXd::Constant(1, 1, length), number(length))};
    EXPECT_GE(optimality_error(1, levels, number(0.0)), 0.1) << length;
    EXPECT_LE(optimality_error(1, levels, number(1.0)), 1e-15) << length;
  }
}

TEST(Certificate, RefusesAShortRowBesideLongOnesThatCanNotAllBeHad) {
  MatrixXd rows(3, 2);
  rows << 1e4, 0.0, 1e4, 0.0, 0.0, 1.0;
  const HierarchyData levels{equalities(rows, Eigen::Vector3d(0.0, 1e4, 3.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(0.5, 3.0)), 1e-12);
  EXPECT_GE(optimality_error(2, levels, Vector2d(0.5, 0.0)), 1e-5);
}

/// Each row becomes up to 10^`most` times as long.
HierarchyData lengthened(HierarchyData levels, double most, RandomMatrices& random) {
  for (LevelData& level : levels) {
    for (Index i = 0; i < level.A.rows(); ++i) {
      const double factor = std::pow(10.0, random.uniform(0.0, most));
      level.A.row(i) *= factor;
      level.lower[i] *= factor;
      level.upper[i] *= factor;
    }
  }
  return levels;
}

TEST(Certificate, ProvesEqualitiesOfOneLevelWhateverTheirLengthsAndRefusesWhatIsBeside) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    HierarchyData levels =
        random_levels(random, {.unknowns = 6, .levels = 3, .max_rows = 9, .inequality_share = 0.0});
    levels.push_back(close_to(random.vector(6)));
    levels = lengthened(levels, 8.0, random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), 1e-12);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-7);
  }
}

TEST(Certificate, ProvesLimitsOfOneLevelAThousandTimesAsLongAndRefusesWhatIsBeside) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = lengthened(levels_with_one_optimum(random), 3.0, random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), 1e-9);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-7);
  }
}

TEST(Certificate, SeesWhatOnlyTheShortRowsOfALevelAskFor) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const MatrixXd R = random.rotation(5);
    const VectorXd b = random.vector(5);
    const VectorXd x = R.transpose() * b;
    const Eigen::VectorXd beside = x + 1e-5 * R.bottomRows(2).transpose() * random.vector(2);
    for (const double length : {1.0, 1e3, 1e6}) {
      VectorXd lengths = VectorXd::Ones(5);
      lengths.head(3).setConstant(length);
      const HierarchyData levels{equalities(lengths.asDiagonal() * R, lengths.cwiseProduct(b))};
      ASSERT_LE(optimality_error(5, levels, x), 1e-14) << length;
      ASSERT_NEAR(optimality_error(5, levels, beside), (beside - x).norm() / (1.0 + beside.norm()),
                  1e-3 * (beside - x).norm())
          << length;
    }
  }
}

TEST(Certificate, ALongLimitFarFromItsBoundExcusesNothing) {
  for (const double length : {1.0, 1e2, 1e4, 1e6}) {
    const HierarchyData levels{
        joined(equalities(MatrixXd::Ones(1, 1), number(1.0)),
               at_most(MatrixXd::Constant(1, 1, length), number(100.0 * length)))};
    EXPECT_LE(optimality_error(1, levels, number(1.0)), 1e-15) << length;
    EXPECT_NEAR(optimality_error(1, levels, number(0.5)), 0.25, 1e-15) << length;
  }
}

TEST(Certificate, RefusesWhatIsBesideAnOptimumAmongLongLimitsFarFromTheirBounds) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const double length = std::pow(10.0, random.uniform(0.0, 4.0));
    const VectorXd x = random.vector(4);
    const MatrixXd R = random.rotation(4);
    const HierarchyData levels{
        joined(equalities(R, R * x),
               at_most(length * random.rotation(4), VectorXd::Constant(4, 100.0 * length)))};
    const VectorXd beside = 1e-3 * (1.0 + x.norm()) * random.vector(4).normalized();
    ASSERT_LE(optimality_error(4, levels, x), 1e-14);
    ASSERT_GE(optimality_error(4, levels, x + beside), 1e-4);
  }
}

TEST(Certificate, ProvesALimitAboveThatHoldsALongRow) {
  for (const double length : {1.0, 1e2, 1e4, 1e6}) {
    for (const double further : {1.0, 1e-3, 1e-6}) {
      const HierarchyData levels{
          at_most(RowVector2d(1.0, 0.0), number(1.0)),
          equalities(Vector2d(length, 1.0).asDiagonal(), Vector2d(length * (1 + further), 0.0))};
      EXPECT_LE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 1e-12) << length << ' ' << further;
      const Vector2d beside(1.0, 0.1);
      const double violations = length * further + 0.1;
      EXPECT_NEAR(optimality_error(2, levels, beside) * (1.0 + beside.norm() + violations), 0.1,
                  1e-6)
          << length << ' ' << further;
    }
  }
}

TEST(Certificate, ALimitThatAnEqualityAboveHasAlreadyHoldsNothing) {
  // In turned coordinates the rest of the limit's row beside the equality is rounding, not zero.
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const MatrixXd R = random.rotation(4);
    const MatrixXd combinations = random.matrix(6, 2);
    const HierarchyData levels{equalities(R.topRows(2), Vector2d::Zero()),
                               at_most(combinations * R.topRows(2), VectorXd::Zero(6)),
                               equalities(R.bottomRows(2), Vector2d(1.0, -1.0))};
    ASSERT_LE(optimality_error(4, levels, R.bottomRows(2).transpose() * Vector2d(1.0, -1.0)),
              1e-14);
    ASSERT_GE(optimality_error(4, levels, VectorXd::Zero(4)), 0.1);
  }
}

TEST(Certificate, RefusesNumbersThatAreNone) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Hierarchy hierarchy =
      make_hierarchy(2, {equalities(MatrixXd::Identity(2, 2), Vector2d(1.0, 1.0)),
                         at_most(RowVector2d(1.0, 0.0), number(1.0)),
                         equalities(RowVector2d(0.0, 1.0), number(2))});
  for (const double poison : {kNaN, kInfinity, -kInfinity}) {
    const auto certificates = certify(hierarchy, Vector2d(1.0, poison));
    ASSERT_EQ(certificates.size(), 3u);
    for (const LevelCertificate& level : certificates) {
      EXPECT_FALSE(std::isfinite(level.residual));
      EXPECT_EQ(level.stationarity, kInfinity);
    }
    EXPECT_EQ(worst_stationarity(certificates), kInfinity);
  }
  EXPECT_EQ(worst_stationarity({{0.0, kNaN}, {0.0, 1e-15}}), kInfinity);
}

TEST(Certificate, RefusesViolationsThatOverflow) {
  const HierarchyData levels{equalities(MatrixXd::Identity(1, 1), number(1e200)),
                             equalities(MatrixXd::Identity(1, 1), number(0.0))};
  EXPECT_EQ(optimality_error(1, levels, number(1e200)), std::numeric_limits<double>::infinity());
}

TEST(Certificate, DoesNotLeaveRowsThatAHigherLevelHoldsWhereWhatItFixesIsNearlyDependent) {
  // In coordinates (p, q1, q2, w), turned at random: the third level pulls at q1 + q2 by so little
  // that the null space of its row is only known to 1e-8, but for certain it holds q1 and q2 where
  // they are, so the fourth has nothing but w to reach further.
  constexpr double kWeak = 5e-9, kWeaker = 3e-9;
  constexpr CertificateOptions kTolerance{.tight = 1e-8, .rank = RankTolerance{}.solve};
  for (int seed = 0; seed < 100; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const MatrixXd R = random.rotation(4);
    const auto row = [&](double p, double q1, double q2, double w) -> MatrixXd {
      return Eigen::RowVector4d(p, q1, q2, w) * R;
    };
    const HierarchyData levels{equalities(row(1, 0, 0, 0), number(0.0)),
                               at_most(R.bottomRows(3), Eigen::Vector3d(0.0, 0.0, 1.0)),
                               equalities(row(1, kWeak, kWeak, 0), number(1.0)),
                               equalities(row(1, 1, -1, kWeaker), number(10.0)),
                               equalities(row(0, 0, 0, 1), number(-5.0))};
    const Hierarchy hierarchy = make_hierarchy(4, levels);
    const Eigen::VectorXd expected = R.transpose() * Eigen::Vector4d(0, 0, 0, 1);
    EXPECT_LE((LexicographicSolver(hierarchy).solve(hierarchy).x - expected).norm(), 1e-12);
    EXPECT_LE((CascadeSolver(hierarchy).solve(hierarchy).x - expected).norm(), 1e-12);
    EXPECT_LE(worst_stationarity(certify(hierarchy, expected, kTolerance)), 1e-12) << seed;
    // Beside it the third level misses its optimum by 1e-9 only, the fourth by a tenth.
    const Eigen::VectorXd beyond = R.transpose() * Eigen::Vector4d(0, -1, 0, 1);
    EXPECT_GE(worst_stationarity(certify(hierarchy, beyond, kTolerance)), 1e-2) << seed;
  }
}

}  // namespace
}  // namespace surefoot::test
