#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;

TEST(Exchange, OfSingleRowsEndsAtTheSameOptimum) {
  for (SeededRandom& random : Seeds(60)) {
    const Hierarchy hierarchy =
        make_hierarchy(kUnknowns, walk_levels(random, 0.5 * (random.seed() % 3)));
    const Solution optimum = LexicographicSolver(hierarchy).solve(hierarchy);
    LexicographicSolver solver(hierarchy, {.max_exchanges = 12});
    const Solution& solution = solver.solve(hierarchy);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE((solution.x - optimum.x).norm(), 1e-8 * (1.0 + optimum.x.norm()));
  }
}

/// A chain of points as straight as possible through gates, of which few bend it.
Hierarchy chain(SeededRandom& random) {
  constexpr Index kPoints = 24;
  Hierarchy hierarchy(kPoints);
  hierarchy.add_level("gates", kPoints);
  hierarchy.add_level("straight", kPoints);
  Rows gates = hierarchy.level(0).add(kPoints, 0);
  Rows straight = hierarchy.level(1).add(kPoints, 0);
  for (Index i = 0; i < kPoints; ++i) {
    const double middle = 0.1 * random.uniform(-1.0, 1.0);
    gates.A(i, i) = 1.0;
    gates.lower[i] = middle - 0.2 + (i % 7 == 3 ? 0.25 : 0.0);
    gates.upper[i] = middle + 0.2;
    straight.A(i, i) = 2.0;
    if (i > 0) straight.A(i, i - 1) = -1.0;
    if (i + 1 < kPoints) straight.A(i, i + 1) = -1.0;
    straight.set_equal(i, 0.0);
  }
  return hierarchy;
}

TEST(Exchange, SparesTheDescentOfATrajectory) {
  double exchanging = 0.0, descending = 0.0;
  for (SeededRandom& random : Seeds(20)) {
    const Hierarchy hierarchy = chain(random);
    descending += LexicographicSolver(hierarchy).solve(hierarchy).flops;
    exchanging += LexicographicSolver(hierarchy, {.max_exchanges = 12}).solve(hierarchy).flops;
  }
  EXPECT_LT(exchanging, 0.5 * descending);
}

}  // namespace
}  // namespace surefoot::solver
