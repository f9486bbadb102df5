// Levels of equalities before the first inequality: rows that end early come first where all are
// independent, which must not show.

#include "surefoot/math/numbers.hpp"
#include "tests/solver/solve.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Equalities whose rows are zero from some column on.
test::LevelData short_rows(test::RandomMatrices& random, Index rows, Index unknowns) {
  test::LevelData level = test::equalities(random.matrix(rows, unknowns), random.vector(rows));
  for (Index i = 0; i < rows; ++i) {
    const Index end = random.integer(static_cast<int>(unknowns) / 3, static_cast<int>(unknowns));
    level.A.row(i).tail(unknowns - end).setZero();
  }
  return level;
}

test::HierarchyData leading_levels(test::RandomMatrices& random, Index unknowns) {
  test::HierarchyData levels;
  for (int k = 0; k < 3; ++k) {
    levels.push_back(
        short_rows(random, random.integer(0, static_cast<int>(unknowns) / 4), unknowns));
  }
  return levels;
}

TEST(LeadingEqualities, WithRowsOfAnyLengthLeaveTheOptimumAndTheFreedomOfTheirOrder) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(3, 40);
    test::HierarchyData levels = leading_levels(random, n);
    levels.push_back(test::at_most(random.matrix(4, n), random.vector(4)));
    levels.push_back(test::close_to(random.vector(n)));
    const Hierarchy hierarchy = test::make_hierarchy(n, levels);
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
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(4, 40);
    test::HierarchyData levels = leading_levels(random, n);
    MatrixXd A(0, n);
    VectorXd b(0);
    for (const test::LevelData& level : levels) {
      A.conservativeResize(A.rows() + level.A.rows(), n);
      b.conservativeResize(A.rows());
      A.bottomRows(level.A.rows()) = level.A;
      b.tail(level.A.rows()) = level.upper;
    }
    const VectorXd shortest = A.rows() > 0 ? VectorXd(A.completeOrthogonalDecomposition().solve(b))
                                           : VectorXd(VectorXd::Zero(n));
    levels.push_back(test::at_most(random.matrix(1, n), VectorXd::Constant(1, kInfinity)));
    const Hierarchy hierarchy = test::make_hierarchy(n, levels);
    for (const SweepKernels* kernels : all_kernels()) {
      SCOPED_TRACE(kernels->name);
      LexicographicSolver solver(hierarchy, {.kernels = kernels});
      ASSERT_LE((solver.solve(hierarchy).x - shortest).norm(), 1e-9 * (1.0 + shortest.norm()));
    }
  }
}

TEST(LeadingEqualities, ThatContradictEachOtherGiveWayByOrderAndNotByLength) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Index n = random.integer(6, 30);
    const test::LevelData second = short_rows(random, 1, n);
    test::LevelData first = test::equalities(random.matrix(2, n), random.vector(2));
    first.A.row(1) = first.A.row(0) + second.A;
    const Solution solution = test::solve<LexicographicSolver>(n, {first, second});
    const double missed = std::abs(first.upper[1] - first.upper[0] - second.upper[0]);
    ASSERT_LE(solution.levels[0].residual, 1e-9);
    ASSERT_NEAR(solution.levels[1].residual, missed, 1e-9);
    ASSERT_EQ(solution.levels[1].degrees_of_freedom_left, n - 2);
  }
}

}  // namespace
}  // namespace surefoot::solver
