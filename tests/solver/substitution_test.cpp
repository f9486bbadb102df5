#include "surefoot/solver/substitution.hpp"

#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kUnknowns = 30;

/// All solutions of the first two levels, in a skew basis and from an arbitrary one of them.
Substitution skew_substitution(const test::HierarchyData& levels, test::RandomMatrices& random) {
  const test::LevelData both = test::joined(levels[0], levels[1]);
  const Eigen::HouseholderQR<MatrixXd> qr(both.A.transpose());
  const MatrixXd Q = qr.householderQ();
  const MatrixXd N = Q.rightCols(kUnknowns - both.A.rows());
  const VectorXd x = both.A.completeOrthogonalDecomposition().solve(both.upper);
  Substitution result;
  result.num_levels = 2;
  result.basis = N * random.matrix(N.cols(), N.cols());
  result.offset = x + N * random.vector(N.cols());
  return result;
}

void expect_same(const test::HierarchyData& levels, test::RandomMatrices& random) {
  const Substitution substitution = skew_substitution(levels, random);
  const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, levels);
  const Solution expected = LexicographicSolver(hierarchy).solve(hierarchy);
  LexicographicSolver solver(hierarchy);
  const Solution& solution = solver.solve(hierarchy, substitution);
  ASSERT_EQ(solution.status, SolveStatus::optimal);
  ASSERT_LE((solution.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
  ASSERT_EQ(solution.levels.back().degrees_of_freedom_left,
            expected.levels.back().degrees_of_freedom_left);
}

TEST(Substitution, GivesTheSameX) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const double aggression = 0.5 * (seed % 3);
    expect_same(test::table_one_levels(random, 2 + seed % 3, aggression), random);
  }
}

TEST(Substitution, GivesTheShortestXWhereItIsOpen) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    test::HierarchyData levels = test::table_one_levels(random, 2 + seed % 3, 0.5 * (seed % 3));
    levels.resize(5);
    expect_same(levels, random);
  }
}

TEST(Substitution, IsNotUsedWhereItDoesNotFit) {
  test::RandomMatrices random(1);
  const test::HierarchyData levels = test::table_one_levels(random, 3, 0.3);
  const Substitution good = skew_substitution(levels, random);
  const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, levels);
  LexicographicSolver solver(hierarchy);
  const VectorXd expected = solver.solve(hierarchy).x;
  Substitution bad = good;
  bad.offset.conservativeResize(7);
  EXPECT_EQ(solver.solve(hierarchy, bad).x, expected);
  bad = good;
  bad.num_levels = 3;  // torque limits are no equalities
  EXPECT_EQ(solver.solve(hierarchy, bad).x, expected);
  bad = good;
  bad.basis(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(solver.solve(hierarchy, bad).x, expected);
  bad.basis.resize(kUnknowns, kUnknowns);
  bad.basis.setIdentity();
  EXPECT_EQ(solver.solve(hierarchy, bad).x, expected);
  for (const double factor : {0.0, 1e-170, 1e170}) {  // a column that is no direction
    bad = good;
    bad.basis.col(2) *= factor;
    EXPECT_EQ(solver.solve(hierarchy, bad).x, expected) << factor;
  }
}

TEST(Substitution, DoesNotAllocate) {
  test::RandomMatrices random(1);
  test::HierarchyData levels = test::table_one_levels(random, 3, 1.0);
  levels.resize(5);
  const Substitution substitution = skew_substitution(levels, random);
  const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, levels);
  LexicographicSolver solver(hierarchy);
  const test::MallocCounter counter;
  (void)solver.solve(hierarchy, substitution);
  EXPECT_EQ(counter.count(), 0u);
}

TEST(Substitution, TheLengthOfItsColumnsDoesNotMatter) {
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    test::HierarchyData levels = test::table_one_levels(random, 2 + seed % 3, 0.5 * (seed % 3));
    if (seed % 2 == 1) levels.resize(5);
    const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, levels);
    const Solution expected = LexicographicSolver(hierarchy).solve(hierarchy);
    Substitution substitution = skew_substitution(levels, random);
    for (Index j = 0; j < substitution.basis.cols(); ++j) {
      substitution.basis.col(j) *= std::pow(10.0, random.integer(-12, 6));
    }
    LexicographicSolver solver(hierarchy);
    const Solution& solution = solver.solve(hierarchy, substitution);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE((solution.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
    substitution.basis *= 3e-11;
    ASSERT_LE((solver.solve(hierarchy, substitution).x - expected.x).norm(),
              1e-9 * (1.0 + expected.x.norm()));
  }
}

}  // namespace
}  // namespace surefoot::solver
