#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kUnknowns = 10;

test::HierarchyData open_case(int seed) {
  test::RandomMatrices random(static_cast<std::uint64_t>(seed));
  return test::random_levels(
      random, {.unknowns = kUnknowns, .levels = 3, .max_rows = 4, .inequality_share = 0.7});
}

TEST(LexicographicOpenOptimum, IsTheShortestOfAll) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::HierarchyData levels = open_case(seed);
    test::HierarchyData shortest = levels;
    shortest.push_back(test::close_to(VectorXd::Zero(kUnknowns)));
    const VectorXd expected = test::solve<CascadeSolver>(kUnknowns, shortest).x;
    const VectorXd x = test::solve<LexicographicSolver>(kUnknowns, levels).x;
    ASSERT_LE((x - expected).norm(), 1e-9 * (1.0 + expected.norm()));
  }
}

TEST(LexicographicOpenOptimum, IsTheShortestWhereTheCascadeHadToSolve) {
  int num_by_cascade = 0;
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, open_case(seed));
    const VectorXd expected = LexicographicSolver(hierarchy).solve(hierarchy).x;
    LexicographicOptions options;
    options.max_sweeps = 1;
    LexicographicSolver solver(hierarchy, options);
    const VectorXd x = solver.solve(hierarchy).x;
    num_by_cascade += solver.num_sweeps() > 1 ? 1 : 0;
    ASSERT_LE((x - expected).norm(), 1e-9 * (1.0 + expected.norm()));
  }
  EXPECT_GT(num_by_cascade, 30);
}

TEST(LexicographicOpenOptimum, DoesNotDependOnTheGuess) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = test::make_hierarchy(kUnknowns, open_case(seed));
    test::HierarchyData other_levels = open_case(seed);
    for (test::LevelData& level : other_levels) level.A *= -1.0;
    LexicographicSolver solver(hierarchy);
    const VectorXd cold = solver.solve(hierarchy).x;
    (void)solver.solve(test::make_hierarchy(kUnknowns, other_levels));
    ASSERT_LE((solver.solve(hierarchy).x - cold).norm(), 1e-9 * (1.0 + cold.norm()));
  }
}

}  // namespace
}  // namespace surefoot::solver
