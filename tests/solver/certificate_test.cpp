#include "surefoot/solver/certificate.hpp"

#include "surefoot/solver/optimality_conditions.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace surefoot::solver {
namespace {

/// Three random levels, and a last one that leaves no choice.
HierarchyData levels_with_one_optimum(RandomMatrices& random) {
  HierarchyData levels = random_levels(random, {.unknowns = 6, .levels = 3, .max_rows = 3});
  levels.push_back(close_to(random.vector(6)));
  return levels;
}

TEST(Certificate, AcceptsTheOptimumAndRefusesWhatIsBesideIt) {
  for (SeededRandom& random : Seeds(100)) {
    const HierarchyData levels = levels_with_one_optimum(random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), kProven);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-6);
  }
}

TEST(Certificate, RefusesALowerLevelThatWasServedFirst) {
  const HierarchyData levels{equalities(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(3.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(1.0, 0.0)), kProven);
  EXPECT_GE(optimality_error(2, levels, Vector2d(3.0, 0.0)), 0.1);
  EXPECT_GE(optimality_error(2, levels, Vector2d(2.0, 0.0)), 0.1);
}

TEST(Certificate, RefusesALimitThatHoldsWithoutNeed) {
  // x = 1 touches the limit x ≤ 1, but the task x = 0 leads away from it.
  const HierarchyData levels{at_most(RowVector2d(1.0, 0.0), number(1.0)),
                             equalities(RowVector2d(1.0, 0.0), number(0.0))};
  EXPECT_GE(optimality_error(2, levels, Vector2d(1.0, 0.0)), 0.1);
  EXPECT_LE(optimality_error(2, levels, Vector2d(0.0, 0.0)), kProven);
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
  for (SeededRandom& random : Seeds(100)) {
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
    EXPECT_LE(optimality_error(1, levels, number(1.0)), kProven) << length;
  }
}

TEST(Certificate, RefusesAShortRowBesideLongOnesThatCanNotAllBeHad) {
  MatrixXd rows(3, 2);
  rows << 1e4, 0.0, 1e4, 0.0, 0.0, 1.0;
  const HierarchyData levels{equalities(rows, Vector3d(0.0, 1e4, 3.0))};
  EXPECT_LE(optimality_error(2, levels, Vector2d(0.5, 3.0)), kProven);
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
  for (SeededRandom& random : Seeds(200)) {
    HierarchyData levels =
        random_levels(random, {.unknowns = 6, .levels = 3, .max_rows = 9, .inequality_share = 0.0});
    levels.push_back(close_to(random.vector(6)));
    levels = lengthened(levels, 8.0, random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), kProven);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-7);
  }
}

TEST(Certificate, ProvesLimitsOfOneLevelAThousandTimesAsLongAndRefusesWhatIsBeside) {
  for (SeededRandom& random : Seeds(200)) {
    const HierarchyData levels = lengthened(levels_with_one_optimum(random), 3.0, random);
    const VectorXd x = solve(6, levels).x;
    ASSERT_LE(optimality_error(6, levels, x), 1e-9);
    ASSERT_GE(optimality_error(6, levels, x + 1e-3 * random.vector(6)), 1e-7);
  }
}

TEST(Certificate, SeesWhatOnlyTheShortRowsOfALevelAskFor) {
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(5);
    const VectorXd b = random.vector(5);
    const VectorXd x = R.transpose() * b;
    const VectorXd beside = x + 1e-5 * R.bottomRows(2).transpose() * random.vector(2);
    for (const double length : {1.0, 1e3, 1e6}) {
      VectorXd lengths = VectorXd::Ones(5);
      lengths.head(3).setConstant(length);
      const HierarchyData levels{equalities(lengths.asDiagonal() * R, lengths.cwiseProduct(b))};
      ASSERT_LE(optimality_error(5, levels, x), kProven) << length;
      double square = 0.0;
      for (Index i = 3; i < 5; ++i)
        square += std::pow(R.row(i).dot(beside - x) / row_unit(R.row(i), beside), 2);
      ASSERT_NEAR(optimality_error(5, levels, beside), std::sqrt(square),
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
    EXPECT_LE(optimality_error(1, levels, number(1.0)), kProven) << length;
    const double unit = row_unit(Eigen::RowVectorXd::Ones(1), number(0.5));
    EXPECT_NEAR(optimality_error(1, levels, number(0.5)), 0.5 / unit, 1e-11) << length;
  }
}

TEST(Certificate, RefusesWhatIsBesideAnOptimumAmongLongLimitsFarFromTheirBounds) {
  for (SeededRandom& random : Seeds(300)) {
    const double length = std::pow(10.0, random.uniform(0.0, 4.0));
    const VectorXd x = random.vector(4);
    const MatrixXd R = random.rotation(4);
    const HierarchyData levels{
        joined(equalities(R, R * x),
               at_most(length * random.rotation(4), VectorXd::Constant(4, 100.0 * length)))};
    const VectorXd beside = 1e-3 * (1.0 + x.norm()) * random.vector(4).normalized();
    ASSERT_LE(optimality_error(4, levels, x), kProven);
    ASSERT_GE(optimality_error(4, levels, x + beside), 1e-4);
  }
}

TEST(Certificate, ProvesALimitAboveThatHoldsALongRow) {
  for (const double length : {1.0, 1e2, 1e4, 1e6}) {
    for (const double further : {1.0, 1e-3, 1e-6}) {
      const HierarchyData levels{
          at_most(RowVector2d(1.0, 0.0), number(1.0)),
          equalities(Vector2d(length, 1.0).asDiagonal(), Vector2d(length * (1 + further), 0.0))};
      EXPECT_LE(optimality_error(2, levels, Vector2d(1.0, 0.0)), kProven)
          << length << ' ' << further;
      const Vector2d beside(1.0, 0.1);
      const double unit = row_unit(RowVector2d(0.0, 1.0), beside);
      const double pull = length * length * further;
      EXPECT_GE(optimality_error(2, levels, beside), 0.1 / (unit + 1e-5 * pull)) << length;
      EXPECT_LE(optimality_error(2, levels, beside), 0.1 / unit) << length;
    }
  }
}

TEST(Certificate, ALimitThatAnEqualityAboveHasAlreadyHoldsNothing) {
  // In turned coordinates the rest of the limit's row besides the equality is rounding, not zero.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd R = random.rotation(4);
    const MatrixXd combinations = random.matrix(6, 2);
    const HierarchyData levels{equalities(R.topRows(2), Vector2d::Zero()),
                               at_most(combinations * R.topRows(2), VectorXd::Zero(6)),
                               equalities(R.bottomRows(2), Vector2d(1.0, -1.0))};
    ASSERT_LE(optimality_error(4, levels, R.bottomRows(2).transpose() * Vector2d(1.0, -1.0)),
              kProven);
    ASSERT_GE(optimality_error(4, levels, VectorXd::Zero(4)), 0.1);
  }
}

TEST(Certificate, RefusesNumbersThatAreNone) {
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

/// (1, 0) x = 0 and (1, e) x = 1, in coordinates turned at random: residual 0 at (0, 1 / e).
HierarchyData nearly_parallel(double e, const MatrixXd& R) {
  MatrixXd rows(2, 2);
  rows << 1.0, 0.0, 1.0, e;
  return {equalities(rows * R, Vector2d(0.0, 1.0))};
}

TEST(Certificate, SeesAResidualAsItIsWhereRowsAreNearlyParallel) {
  for (const double e : {1.0, 1e-2, 1e-4}) {
    for (int seed = 0; seed < 20; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", e " + std::to_string(e));
      RandomMatrices random(static_cast<std::uint64_t>(seed));
      const MatrixXd R = random.rotation(2);
      const HierarchyData levels = nearly_parallel(e, R);
      ASSERT_LE(optimality_error(2, levels, R.transpose() * Vector2d(0.0, 1.0 / e)), kProven);
      const double h = random.uniform(0.01, 0.5);
      const VectorXd x = R.transpose() * Vector2d(h, (1.0 - 2.0 * h) / e);
      const double residual = std::sqrt(2.0) * h;
      const double one = row_unit(levels[0].A.row(0), x), other = row_unit(levels[0].A.row(1), x);
      ASSERT_GE(optimality_error(2, levels, x), 0.5 * residual / std::max(one, other));
      ASSERT_LE(optimality_error(2, levels, x), 2.0 * residual / std::min(one, other));
    }
  }
}

TEST(Certificate, NoMoreResidualIsLeftToGainThanItSays) {
  // One level: its residual against the least, whatever the units of unknowns and lengths of rows.
  for (SeededRandom& random : Seeds(500)) {
    MatrixXd A = random.matrix(5, 4);
    for (auto column : A.colwise()) column *= std::pow(10.0, random.uniform(-3.0, 3.0));
    for (auto row : A.rowwise()) row *= std::pow(10.0, random.uniform(-1.0, 1.0));
    const VectorXd b = random.vector(5);
    const VectorXd best = test::least_squares(A, b);
    const VectorXd x = best + std::pow(10.0, -random.integer(1, 8)) * random.vector(4);
    const double gain =
        std::sqrt(std::max(0.0, (A * x - b).squaredNorm() - (A * best - b).squaredNorm()));
    const double unit = A.rowwise().norm().maxCoeff() * (1.0 + x.norm());
    ASSERT_GE(optimality_error(4, {equalities(A, b)}, x), 0.1 * gain / unit - 1e-12);
  }
}

TEST(Certificate, RefusesAnswersToAnotherOrderOfLevels) {
  int refused = 0;
  for (SeededRandom& random : Seeds(2000)) {
    const HierarchyData levels = random_levels(random, {.unknowns = 5,
                                                        .levels = 4,
                                                        .max_rows = 4,
                                                        .duplicate_share = 0.2,
                                                        .dependent_share = 0.1,
                                                        .tight_share = 0.5,
                                                        .integer_share = 0.5});
    HierarchyData swapped = levels;
    std::swap(swapped[1], swapped[2]);
    const VectorXd x = solve(5, swapped).x;
    const double best = solve(5, levels).levels[1].residual;
    const double reached = certify(make_hierarchy(5, levels), x)[1].residual;
    const bool is_worse = reached > best + 1e-4 * (1.0 + best);
    const double error = optimality_error(5, levels, x);
    ASSERT_TRUE(!is_worse || error >= 1e-7) << error;
    refused += is_worse ? 1 : 0;
  }
  EXPECT_GE(refused, 300);
}

TEST(Certificate, OfSomeLevelsIsThatOfThese) {
  RandomMatrices random(1);
  const HierarchyData levels = levels_with_one_optimum(random);
  const Hierarchy hierarchy = make_hierarchy(6, levels);
  const VectorXd x = random.vector(6);
  const auto all = certify(hierarchy, x);
  const auto some = certify(hierarchy, x, {.levels = 2});
  ASSERT_EQ(some.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(some[k].stationarity, all[k].stationarity);
  EXPECT_EQ(certify(hierarchy, VectorXd::Constant(6, std::nan("")), {.levels = 2}).size(), 2u);
}

}  // namespace
}  // namespace surefoot::solver
