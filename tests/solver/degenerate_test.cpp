#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::solver {
namespace {

/// Random rows of a given rank, with a right-hand side that they can't all meet.
LevelData rank_deficient(RandomMatrices& random, Index rows, Index rank, Index unknowns) {
  return equalities(random.matrix(rows, rank) * random.matrix(rank, unknowns), random.vector(rows));
}

template <typename Solver>
class Degenerate : public testing::Test {};
TYPED_TEST_SUITE(Degenerate, Solvers);

TYPED_TEST(Degenerate, RankDeficientLevelsTakeAsManyDirectionsAsTheirRank) {
  for (SeededRandom& random : Seeds(200)) {
    HierarchyData levels;
    std::vector<Index> ranks;
    for (int k = 0; k < 4; ++k) {
      ranks.push_back(random.integer(0, 3));
      levels.push_back(rank_deficient(random, 5, ranks.back(), 10));
    }
    const Solution solution = solve<TypeParam>(10, levels);
    Index left = 10;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      left -= std::min(ranks[k], left);
      ASSERT_EQ(solution.levels[k].degrees_of_freedom_left, left) << "level " << k;
    }
    ASSERT_LE(optimality_error(10, levels, solution.x), 1e-9);
  }
}

TYPED_TEST(Degenerate, ARepeatedLevelHasNoEffect) {
  for (SeededRandom& random : Seeds(200)) {
    const HierarchyData levels = random_levels(random, {.unknowns = 8, .levels = 5, .max_rows = 4});
    HierarchyData repeated;
    for (const LevelData& level : levels) {
      repeated.push_back(level);
      repeated.push_back(level);
    }
    const std::vector<double> once = residuals(solve<TypeParam>(8, levels));
    const std::vector<double> twice = residuals(solve<TypeParam>(8, repeated));
    for (std::size_t k = 0; k < levels.size(); ++k) {
      ASSERT_NEAR(once[k], twice[2 * k], 1e-9 * (1.0 + once[k]));
      ASSERT_NEAR(once[k], twice[2 * k + 1], 1e-9 * (1.0 + once[k]));
    }
  }
}

TYPED_TEST(Degenerate, AConflictingCopyOfALevelDoesNotMoveIt) {
  for (SeededRandom& random : Seeds(200)) {
    const LevelData level = equalities(random.matrix(4, 7), random.vector(4));
    const LevelData copy = equalities(level.A, random.vector(4));
    const Solution alone = solve<TypeParam>(7, {level});
    const Solution both = solve<TypeParam>(7, {level, copy});
    ASSERT_LE((alone.x - both.x).norm(), 1e-12);
    ASSERT_NEAR(both.levels[1].residual, (copy.lower - level.lower).norm(), 1e-9);
  }
}

TYPED_TEST(Degenerate, ZeroRowsKeepTheirResidualAndTakeNoFreedom) {
  const LevelData zero = equalities(MatrixXd::Zero(2, 3), Vector2d(1.0, -2.0));
  const LevelData limit = at_most(MatrixXd::Zero(1, 3), number(-3.0));
  const Solution solution = solve<TypeParam>(3, {zero, limit, close_to(Vector3d(1.0, 2.0, 3.0))});
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(5.0), 1e-15);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 3);
  EXPECT_NEAR(solution.levels[1].residual, 3.0, 1e-15);
  EXPECT_NEAR((solution.x - Vector3d(1.0, 2.0, 3.0)).norm(), 0.0, 1e-15);
}

TYPED_TEST(Degenerate, MoreRowsThanUnknownsAreLeastSquares) {
  for (SeededRandom& random : Seeds(200)) {
    const Index n = random.integer(1, 6);
    const HierarchyData levels = random_levels(
        random, {.unknowns = n, .levels = 3, .max_rows = 20, .inequality_share = 0.6});
    const Solution solution = solve<TypeParam>(n, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(n, levels, solution.x), 1e-9);
  }
}

TYPED_TEST(Degenerate, DuplicatedDependentAndZeroRowsAreSolvedExactly) {
  for (SeededRandom& random : Seeds(1000)) {
    const HierarchyData levels = random_levels(random, {.unknowns = 8,
                                                        .levels = 6,
                                                        .max_rows = 6,
                                                        .inequality_share = 0.7,
                                                        .duplicate_share = 0.2,
                                                        .dependent_share = 0.2,
                                                        .zero_share = 0.05});
    const Solution solution = solve<TypeParam>(8, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(8, levels, solution.x), 1e-9);
  }
}

/// A level whose second singular value is about `sigma`, below it one that wants x₁ = 0.
template <typename Solver>
Solution nearly_singular(double sigma) {
  const MatrixXd A = (MatrixXd(2, 2) << 1.0, 0.0, 1.0, sigma).finished();
  return solve<Solver>(
      2, {equalities(A, Vector2d(1.0, 2.0)), equalities(RowVector2d(0.0, 1.0), number(0.0))});
}

TYPED_TEST(Degenerate, AWeakDirectionIsUsedDownToTheRankToleranceAndNotBelow) {
  const double tolerance = RankTolerance{}.solve;
  for (int step = 0; step <= 120; ++step) {
    const double sigma = std::pow(10.0, -2.0 - 0.1 * step);
    SCOPED_TRACE("singular value " + std::to_string(std::log10(sigma)));
    const Solution solution = nearly_singular<TypeParam>(sigma);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    const bool is_used = sigma > 1.01 * tolerance;
    ASSERT_NEAR(solution.levels[0].residual, is_used ? 0.0 : std::sqrt(0.5), 1e-7);
    ASSERT_NEAR(solution.x[1] * sigma, is_used ? 1.0 : 0.0, 1e-6);
    ASSERT_LE(solution.x.norm(), is_used ? 10.0 / sigma : 10.0);
  }
}

TYPED_TEST(Degenerate, AWeakDirectionNeverBlowsXUpBeyondTheInverseOfTheTolerance) {
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd U = random.rotation(6);
    const MatrixXd V = random.rotation(6);
    for (int exponent = 2; exponent <= 14; ++exponent) {
      VectorXd singular = VectorXd::Ones(6);
      singular[5] = std::pow(10.0, -exponent);
      const MatrixXd A = U * singular.asDiagonal() * V.transpose();
      const VectorXd b = random.vector(6), wish = random.vector(6);
      const Solution solution = solve<TypeParam>(6, {equalities(A, b), close_to(wish)});
      ASSERT_EQ(solution.status, SolveStatus::optimal);
      ASSERT_LE(solution.x.norm(), 10.0 * (b.norm() + wish.norm()) / RankTolerance{}.solve)
          << "1e-" << exponent;
    }
  }
}

/// Ten singular values 1 … 1 and σ, a level below that wants another x, turned at random.
template <typename Solver>
void expect_certified_at(double sigma) {
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", σ " + std::to_string(std::log10(sigma)));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    VectorXd singular = VectorXd::Ones(5);
    singular[4] = sigma;
    const MatrixXd A = random.rotation(5) * singular.asDiagonal() * random.rotation(5);
    const HierarchyData levels{equalities(A, random.vector(5)),
                               at_most(random.matrix(2, 5), random.vector(2)),
                               close_to(random.vector(5))};
    const Solution solution = solve<Solver>(5, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(5, levels, solution.x), 1e-7);
  }
}

TYPED_TEST(Degenerate, AwayFromTheRankToleranceEveryAnswerIsCertified) {
  for (int exponent = 2; exponent <= 6; ++exponent) {
    expect_certified_at<TypeParam>(std::pow(10.0, -exponent));
  }
  expect_certified_at<TypeParam>(1e-15);
  expect_certified_at<TypeParam>(0.0);
}

/// Where a singular value falls below the tolerance, the residual of its level steps up once, to
/// that of the level without this direction, and never beyond.
TYPED_TEST(Degenerate, TheResidualStepsOnceAsASingularValueFalls) {
  // Of the residual of rows not longer than 1, relative to ‖x‖.
  constexpr double kRounding = 10.0 * std::numeric_limits<double>::epsilon();
  for (SeededRandom& random : Seeds(50)) {
    const MatrixXd U = random.rotation(5), V = random.rotation(5);
    const VectorXd b = random.vector(5);
    const double without = std::abs(U.col(4).dot(b));
    double before = 0.0, rounding_before = 0.0;
    for (int step = 0; step <= 120; ++step) {
      VectorXd singular = VectorXd::Ones(5);
      singular[4] = std::pow(10.0, -2.0 - 0.1 * step);
      const HierarchyData levels{equalities(U * singular.asDiagonal() * V, b)};
      const Solution solution = solve<TypeParam>(5, levels);
      const double residual = solution.levels[0].residual;
      const double rounding = kRounding * (solution.x.norm() + b.norm());
      ASSERT_GE(residual, before - rounding - rounding_before) << "step " << step;
      ASSERT_LE(residual, without + rounding) << "step " << step;
      before = residual;
      rounding_before = rounding;
    }
    ASSERT_NEAR(before, without, 1e-6);
  }
}

TYPED_TEST(Degenerate, AWeakDirectionIsNotGivenToLowerLevels) {
  // Too weak to be used, too strong to be given away: level 2 must not disturb level 1.
  const double sigma = 1e-10;
  const Solution alone = solve<TypeParam>(
      2, {equalities((MatrixXd(2, 2) << 1.0, 0.0, 1.0, sigma).finished(), Vector2d(1.0, 2.0))});
  const LevelData strong = equalities(RowVector2d(0.0, 1.0), number(1e9));
  const Solution both = solve<TypeParam>(
      2, {equalities((MatrixXd(2, 2) << 1.0, 0.0, 1.0, sigma).finished(), Vector2d(1.0, 2.0)),
          strong});
  EXPECT_EQ(alone.levels[0].degrees_of_freedom_left, 0);
  EXPECT_NEAR(both.levels[0].residual, alone.levels[0].residual, 1e-12);
}

TYPED_TEST(Degenerate, RoundingOfAWeakDirectionDoesNotPassForAnotherOne) {
  // Level 1 spans a plane by rows that are almost parallel, level 2 lies in that plane.
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd Q = random.rotation(3);
    const MatrixXd A1 = (MatrixXd(2, 3) << 1.0, 0.0, 0.0, 1.0, 1e-6, 0.0).finished() * Q;
    const MatrixXd A2 = (MatrixXd(1, 3) << 1.0, 2.0, 0.0).finished() * Q;
    const Solution solution =
        solve<TypeParam>(3, {equalities(A1, Vector2d(1.0, 1.0)), equalities(A2, number(3.0))});
    ASSERT_EQ(solution.levels[0].degrees_of_freedom_left, 1);
    ASSERT_EQ(solution.levels[1].degrees_of_freedom_left, 1);
  }
}

TYPED_TEST(Degenerate, TwoTasksInConflictLoseRankTogether) {
  // A₁ and A₂ have full rank each, A₂ Z₁ has not (Eq. 12).
  const MatrixXd A1 = (MatrixXd(1, 3) << 1.0, 1.0, 0.0).finished();
  const MatrixXd A2 = (MatrixXd(2, 3) << 2.0, 2.0, 0.0, 0.0, 0.0, 1.0).finished();
  const Solution solution =
      solve<TypeParam>(3, {equalities(A1, number(1.0)), equalities(A2, Vector2d(4.0, 5.0))});
  EXPECT_EQ(solution.levels[1].degrees_of_freedom_left, 1);
  EXPECT_NEAR(solution.levels[1].residual, 2.0, 1e-12);
  EXPECT_NEAR(solution.x[2], 5.0, 1e-12);
}

}  // namespace
}  // namespace surefoot::solver
