#include "surefoot/solver/turning_least_squares.hpp"

#include "tests/solver/solve.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <string>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Minimum over the last `free` columns by a fresh factorization.
VectorXd fresh_step(const MatrixXd& B, const VectorXd& r, Index free) {
  return B.rightCols(free).householderQr().solve(-r);
}

TEST(TurningLeastSquares, FollowsRotationsStepsAndAChangingNumberOfFreeColumns) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(2, 12);
    MatrixXd B = random.matrix(n + random.integer(0, 5), n);
    VectorXd r = random.vector(B.rows());
    TurningLeastSquares least_squares(20, 12);
    ASSERT_TRUE(least_squares.start(B, r));
    for (int k = 0; k < 40; ++k) {
      const Index column = random.integer(0, static_cast<int>(n) - 2);
      const Rotation rotation = make_rotation(random.normal(), random.normal());
      least_squares.rotate(column, rotation);
      rotate_columns(rotation, B.col(column), B.col(column + 1));
      const Index free = random.integer(1, static_cast<int>(n));
      VectorXd p(free);
      least_squares.step(p);
      const VectorXd expected = fresh_step(B, r, free);
      ASSERT_LE((p - expected).norm(), 1e-9 * (1.0 + expected.norm()));
      const double length = random.uniform(0.0, 0.5);
      r += length * B.rightCols(free) * p;
      least_squares.advance(free, length);
    }
  }
}

TEST(TurningLeastSquares, DoesNotStartWithoutFullColumnRank) {
  test::RandomMatrices random(1);
  TurningLeastSquares least_squares(20, 12);
  EXPECT_FALSE(least_squares.start(random.matrix(4, 5), random.vector(4)));
  EXPECT_FALSE(least_squares.start(random.matrix(9, 3) * random.matrix(3, 5), random.vector(9)));
  EXPECT_FALSE(least_squares.is_running());
  EXPECT_TRUE(least_squares.start(random.matrix(9, 5), random.vector(9)));
  least_squares.stop();
  EXPECT_FALSE(least_squares.is_running());
}

TEST(CascadeWithLargeLevels, LeastSquaresUnderManyLimitsIsOptimal) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(10, 40);
    const test::HierarchyData levels = test::least_squares_under_limits(random, n);
    const Solution solution = test::solve(n, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(test::optimality_error(n, levels, solution.x), 1e-9);
    ASSERT_GE(solution.levels[1].num_active(), 1);
  }
}

TEST(CascadeWithLargeLevels, ALevelOfDependentColumnsUnderManyLimitsIsOptimal) {
  // Too few independent rows to be updated, so it is factorized again at each step.
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = 20;
    test::HierarchyData levels = test::least_squares_under_limits(random, n);
    levels[2].A = random.matrix(30, 8) * random.matrix(8, n);
    const Solution solution = test::solve(n, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(test::optimality_error(n, levels, solution.x), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::solver
