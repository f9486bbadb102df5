#include "surefoot/solver/budget.hpp"

#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace surefoot::test {
namespace {

constexpr Eigen::Index kUnknowns = 30;
constexpr double kTolerance = 1e-8;

LexicographicOptions with_flops(double flops) {
  LexicographicOptions options;
  options.budget.flops = flops;
  return options;
}

/// Violation of a level at x.
double residual(const Level& level, const Eigen::VectorXd& x) {
  const Eigen::VectorXd value = level.A() * x;
  return (value - level.upper()).cwiseMax(level.lower() - value).cwiseMax(0.0).norm();
}

/// Every finished level is as good as at the optimum.
void expect_safe(const Hierarchy& hierarchy, const Solution& solution, const Solution& optimum) {
  ASSERT_EQ(solution.status, SolveStatus::iteration_cap);
  ASSERT_GE(solution.failed_level, 0);
  for (std::size_t k = 0; k < static_cast<std::size_t>(solution.failed_level); ++k) {
    const double expected = optimum.levels[k].residual;
    ASSERT_NEAR(residual(hierarchy.level(k), solution.x), expected, kTolerance * (1.0 + expected));
    ASSERT_NEAR(solution.levels[k].residual, expected, kTolerance * (1.0 + expected));
  }
}

TEST(Budget, WhereverItEndsTheFinishedLevelsAreOptimal) {
  int num_early = 0, most_finished = 0;
  for (int seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Hierarchy hierarchy =
        make_hierarchy(kUnknowns, table_one_levels(random, 2 + seed % 3, 0.5 * (seed % 3)));
    const Solution optimum = LexicographicSolver(hierarchy).solve(hierarchy);
    int finished = 0;
    for (double flops = 0.0; flops < 1e6; flops += 4e3) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy);
      if (solution.status == SolveStatus::optimal) {
        ASSERT_LE((solution.x - optimum.x).norm(), kTolerance * (1.0 + optimum.x.norm()));
        continue;
      }
      expect_safe(hierarchy, solution, optimum);
      ASSERT_GE(solution.failed_level, finished) << "more is never less";
      finished = solution.failed_level;
      ++num_early;
    }
    most_finished = std::max(most_finished, finished);
  }
  EXPECT_GT(num_early, 200);
  EXPECT_GT(most_finished, 5);
}

TEST(Budget, ItsEndIsTheSameToTheBit) {
  RandomMatrices random(2);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, table_one_levels(random, 3, 1.0));
  const Solution first = LexicographicSolver(hierarchy, with_flops(2e4)).solve(hierarchy);
  const Solution second = LexicographicSolver(hierarchy, with_flops(2e4)).solve(hierarchy);
  ASSERT_EQ(first.status, SolveStatus::iteration_cap);
  EXPECT_EQ(first.x, second.x);
}

/// One second later each time that it is asked.
double late_clock() {
  static double now = 0.0;
  return now += 1.0;
}

TEST(Budget, WithNoTimeAtAllTheLeadingEqualitiesHold) {
  RandomMatrices random(5);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, table_one_levels(random, 3, 1.0));
  LexicographicOptions options;
  options.budget.seconds = 1e-3;
  options.clock = late_clock;
  LexicographicSolver solver(hierarchy, options);
  const MallocCounter counter;
  const Solution& solution = solver.solve(hierarchy);
  EXPECT_EQ(counter.count(), 0u);
  ASSERT_EQ(solution.status, SolveStatus::iteration_cap);
  EXPECT_EQ(solution.failed_level, 2);
  EXPECT_LE(residual(hierarchy.level(0), solution.x), kTolerance);
  EXPECT_LE(residual(hierarchy.level(1), solution.x), kTolerance);
}

TEST(Budget, ALevelThatIsCutShortIsBetterThanBefore) {
  // The level that was being solved has not become worse than where the level before had left it.
  for (int seed = 0; seed < 60; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = table_one_levels(random, 2 + seed % 3, 1.0);
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    double last = 0.0;
    int last_level = -1;
    for (double flops = 0.0; flops < 4e5; flops += 4e3) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy);
      if (solution.status == SolveStatus::optimal) break;
      const double now = solution.levels[static_cast<std::size_t>(solution.failed_level)].residual;
      if (solution.failed_level == last_level) {
        ASSERT_LE(now, last + kTolerance * (1.0 + last)) << "seed " << seed;
      }
      last = now;
      last_level = solution.failed_level;
    }
  }
}

}  // namespace
}  // namespace surefoot::test
