#include "surefoot/solver/turning_least_squares.hpp"

#include "tests/solver/solve.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

namespace surefoot::solver {
namespace {

TEST(TurningLeastSquares, FollowsRotationsStepsAndAChangingNumberOfFreeColumns) {
  for (SeededRandom& random : Seeds(100)) {
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
      const VectorXd expected = B.rightCols(free).householderQr().solve(-r);
      ASSERT_LE((p - expected).norm(), 1e-9 * (1.0 + expected.norm()));
      const double length = random.uniform(0.0, 0.5);
      r += length * B.rightCols(free) * p;
      least_squares.advance(free, length);
    }
  }
}

TEST(TurningLeastSquares, DoesNotStartWithoutFullColumnRank) {
  RandomMatrices random(1);
  TurningLeastSquares least_squares(20, 12);
  EXPECT_FALSE(least_squares.start(random.matrix(4, 5), random.vector(4)));
  EXPECT_FALSE(least_squares.start(random.matrix(9, 3) * random.matrix(3, 5), random.vector(9)));
  EXPECT_FALSE(least_squares.is_running());
}

TEST(CascadeWithLargeLevels, LeastSquaresUnderManyLimitsIsOptimal) {
  for (SeededRandom& random : Seeds(30)) {
    const Index n = random.integer(10, 40);
    const HierarchyData levels = test::least_squares_under_limits(random, n);
    const Solution solution = solve(n, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(n, levels, solution.x), 1e-9);
    ASSERT_GE(solution.levels[1].num_active(), 1);
  }
}

TEST(CascadeWithLargeLevels, ALevelOfDependentColumnsUnderManyLimitsIsOptimal) {
  // Too few independent rows to be updated, so it is factorized again at each step.
  for (SeededRandom& random : Seeds(30)) {
    HierarchyData levels = test::least_squares_under_limits(random, 20);
    levels[2].A = random.matrix(30, 8) * random.matrix(8, 20);
    const Solution solution = solve(20, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(20, levels, solution.x), 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::solver
