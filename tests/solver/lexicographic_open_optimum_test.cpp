#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 10;

TEST(LexicographicOpenOptimum, IsTheShortestOfAllWhateverTheGuessAndWhereTheCascadeHadToSolve) {
  int num_by_cascade = 0;
  for (SeededRandom& random : Seeds(300)) {
    const HierarchyData levels = random_levels(
        random, {.unknowns = kUnknowns, .levels = 3, .max_rows = 4, .inequality_share = 0.7});
    HierarchyData shortest = levels, opposite = levels;
    shortest.push_back(close_to(VectorXd::Zero(kUnknowns)));
    for (LevelData& level : opposite) level.A *= -1.0;
    const VectorXd expected = solve(kUnknowns, shortest).x;
    const double rounding = 1e-9 * (1.0 + expected.norm());

    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    LexicographicSolver solver(hierarchy);
    ASSERT_LE((solver.solve(hierarchy).x - expected).norm(), rounding);
    (void)solver.solve(make_hierarchy(kUnknowns, opposite));
    ASSERT_LE((solver.solve(hierarchy).x - expected).norm(), rounding) << "with another guess";
    LexicographicSolver given_up(hierarchy, {.max_sweeps = 1});
    ASSERT_LE((given_up.solve(hierarchy).x - expected).norm(), rounding) << "by the cascade";
    num_by_cascade += given_up.num_sweeps() > 1 ? 1 : 0;
  }
  EXPECT_GT(num_by_cascade, 30);
}

}  // namespace
}  // namespace surefoot::solver
