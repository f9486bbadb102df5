#include "surefoot/solver/substitution.hpp"

#include "tests/solver/solve.hpp"
#include "tests/support/substitutions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;

void expect_same(const HierarchyData& levels, RandomMatrices& random) {
  const Substitution substitution = skew_substitution_of(levels, 2, random);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
  const Solution expected = LexicographicSolver(hierarchy).solve(hierarchy);
  LexicographicSolver solver(hierarchy);
  const Solution& solution = solver.solve(hierarchy, substitution);
  ASSERT_EQ(solution.status, SolveStatus::optimal);
  ASSERT_LE((solution.x - expected.x).norm(), 1e-9 * (1.0 + expected.x.norm()));
  ASSERT_EQ(solution.levels.back().degrees_of_freedom_left,
            expected.levels.back().degrees_of_freedom_left);
}

TEST(Substitution, GivesTheSameXAndTheShortestWhereItIsOpen) {
  for (const std::size_t num_levels : {11u, 5u}) {
    for (SeededRandom& random : Seeds(200)) {
      HierarchyData levels = walk_levels(random, 0.5 * (random.seed() % 3));
      levels.resize(num_levels);
      expect_same(levels, random);
    }
  }
}

TEST(Substitution, IsNotUsedWhereItDoesNotFit) {
  RandomMatrices random(1);
  const HierarchyData levels = table_one_levels(random, 3, 0.3);
  const Substitution good = skew_substitution_of(levels, 2, random);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
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

TEST(Substitution, TheLengthOfItsColumnsDoesNotMatter) {
  for (SeededRandom& random : Seeds(60)) {
    HierarchyData levels = walk_levels(random, 0.5 * (random.seed() % 3));
    if (random.seed() % 2 == 1) levels.resize(5);
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    const Solution expected = LexicographicSolver(hierarchy).solve(hierarchy);
    Substitution substitution = skew_substitution_of(levels, 2, random);
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
