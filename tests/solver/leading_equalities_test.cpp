// Levels of equalities before the first inequality: rows that end early come first where all are
// independent, which must not show.

#include "tests/solver/solve.hpp"
#include "tests/support/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::solver {
namespace {

/// Equalities whose rows are zero from some column on.
LevelData short_rows(RandomMatrices& random, Index rows, Index unknowns) {
  LevelData level = equalities(random.matrix(rows, unknowns), random.vector(rows));
  for (Index i = 0; i < rows; ++i) {
    const Index end = random.integer(static_cast<int>(unknowns) / 3, static_cast<int>(unknowns));
    level.A.row(i).tail(unknowns - end).setZero();
  }
  return level;
}

HierarchyData leading_levels(RandomMatrices& random, Index unknowns) {
  HierarchyData levels;
  for (int k = 0; k < 3; ++k) {
    levels.push_back(
        short_rows(random, random.integer(0, static_cast<int>(unknowns) / 4), unknowns));
  }
  return levels;
}

TEST(LeadingEqualities, WithRowsOfAnyLengthLeaveTheOptimumAndTheFreedomOfTheirOrder) {
  for (SeededRandom& random : Seeds(300)) {
    const Index n = random.integer(3, 40);
    HierarchyData levels = leading_levels(random, n);
    levels.push_back(at_most(random.matrix(4, n), random.vector(4)));
    levels.push_back(close_to(random.vector(n)));
    const Hierarchy hierarchy = make_hierarchy(n, levels);
    CascadeSolver cascade(hierarchy);
    const Solution& expected = cascade.solve(hierarchy);
    for (const SweepKernels* kernels : all_kernels()) {
      SCOPED_TRACE(kernels->name);
      LexicographicSolver solver(hierarchy, {.kernels = kernels});
      const Solution& solution = solver.solve(hierarchy);
      ASSERT_LE(solver.num_sweeps(), LexicographicOptions{}.max_sweeps);
      ASSERT_LE((solution.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(solution.levels[k].degrees_of_freedom_left,
                  expected.levels[k].degrees_of_freedom_left);
      }
    }
  }
}

TEST(LeadingEqualities, WithRowsOfAnyLengthLeaveTheShortestX) {
  for (SeededRandom& random : Seeds(300)) {
    const Index n = random.integer(4, 40);
    HierarchyData levels = leading_levels(random, n);
    MatrixXd A(0, n);
    VectorXd b(0);
    for (const LevelData& level : levels) {
      A.conservativeResize(A.rows() + level.A.rows(), n);
      b.conservativeResize(A.rows());
      A.bottomRows(level.A.rows()) = level.A;
      b.tail(level.A.rows()) = level.upper;
    }
    const VectorXd shortest =
        A.rows() > 0 ? VectorXd(test::least_squares(A, b)) : VectorXd(VectorXd::Zero(n));
    levels.push_back(at_most(random.matrix(1, n), VectorXd::Constant(1, kInfinity)));
    const Hierarchy hierarchy = make_hierarchy(n, levels);
    for (const SweepKernels* kernels : all_kernels()) {
      SCOPED_TRACE(kernels->name);
      LexicographicSolver solver(hierarchy, {.kernels = kernels});
      ASSERT_LE((solver.solve(hierarchy).x - shortest).norm(), 1e-9 * (1.0 + shortest.norm()));
    }
  }
}

TEST(LeadingEqualities, ThatContradictEachOtherGiveWayByOrderAndNotByLength) {
  for (SeededRandom& random : Seeds(100)) {
    const Index n = random.integer(6, 30);
    const LevelData second = short_rows(random, 1, n);
    LevelData first = equalities(random.matrix(2, n), random.vector(2));
    first.A.row(1) = first.A.row(0) + second.A;
    const Solution solution = solve<LexicographicSolver>(n, {first, second});
    const double missed = std::abs(first.upper[1] - first.upper[0] - second.upper[0]);
    ASSERT_LE(solution.levels[0].residual, 1e-9);
    ASSERT_NEAR(solution.levels[1].residual, missed, 1e-9);
    ASSERT_EQ(solution.levels[1].degrees_of_freedom_left, n - 2);
  }
}

}  // namespace
}  // namespace surefoot::solver
