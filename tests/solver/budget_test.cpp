#include "surefoot/solver/budget.hpp"

#include "surefoot/base/error.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/substitutions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;
constexpr double kTolerance = 1e-8;

LexicographicOptions with_flops(double flops) {
  LexicographicOptions options;
  options.budget.flops = flops;
  return options;
}

/// Violation of a level at x.
double residual(const Level& level, const VectorXd& x) {
  const VectorXd value = level.A() * x;
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
  for (SeededRandom& random : Seeds(60)) {
    const Hierarchy hierarchy =
        make_hierarchy(kUnknowns, walk_levels(random, 0.5 * (random.seed() % 3)));
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

TEST(Budget, EqualitiesAreSolvedInAnyCaseSoTheyAreOptimalWithoutOne) {
  for (SeededRandom& random : Seeds(20)) {
    HierarchyData levels;
    for (const Index rows : {6, 8, 1 + random.seed()}) {
      const VectorXd b = random.vector(rows);
      levels.push_back({random.matrix(rows, kUnknowns), b, b});
    }
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    const Solution optimum = LexicographicSolver(hierarchy).solve(hierarchy);
    const Solution solution = LexicographicSolver(hierarchy, with_flops(0.0)).solve(hierarchy);
    EXPECT_EQ(solution.status, SolveStatus::optimal);
    EXPECT_EQ(solution.failed_level, -1);
    EXPECT_LE((solution.x - optimum.x).norm(), kTolerance * (1.0 + optimum.x.norm()));
  }
}

TEST(Budget, SpentBetweenTheLastLevelAndTheProofTheOptimumIsCalledIt) {
  int num_before_the_end = 0;
  for (SeededRandom& random : Seeds(60)) {
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, walk_levels(random, 1.0));
    LexicographicSolver whole(hierarchy);
    const Solution optimum = whole.solve(hierarchy);
    const double all = whole.flops();
    for (double flops = 0.5 * all; flops < all; flops += 0.01 * all) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy);
      if (solution.status != SolveStatus::optimal) continue;
      ASSERT_EQ(solution.failed_level, -1);
      ASSERT_LE((solution.x - optimum.x).norm(), kTolerance * (1.0 + optimum.x.norm()));
      for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
        const LevelResult &now = solution.levels[k], &then = optimum.levels[k];
        ASSERT_EQ(now.degrees_of_freedom_left, then.degrees_of_freedom_left);
      }
      num_before_the_end += solver.flops() < all ? 1 : 0;
    }
  }
  EXPECT_GT(num_before_the_end, 20);
}

TEST(Budget, ThatIsNoNumberFromZeroOnIsRefused) {
  const Hierarchy hierarchy(2);
  EXPECT_THROW(LexicographicSolver(hierarchy, with_flops(std::nan(""))), Error);
  EXPECT_THROW(LexicographicSolver(hierarchy, with_flops(-1.0)), Error);
  EXPECT_NO_THROW(LexicographicSolver(hierarchy, with_flops(0.0)));
}

TEST(Budget, ItsEndIsTheSameToTheBit) {
  RandomMatrices random(2);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, table_one_levels(random, 3, 1.0));
  const Solution first = LexicographicSolver(hierarchy, with_flops(2e4)).solve(hierarchy);
  const Solution second = LexicographicSolver(hierarchy, with_flops(2e4)).solve(hierarchy);
  ASSERT_EQ(first.status, SolveStatus::iteration_cap);
  EXPECT_EQ(first.x, second.x);
}

/// Advances by a second at each call.
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

TEST(Budget, ALevelThatIsCutShortLaterIsNoWorse) {
  // More of a budget never makes the level worse that is being solved.
  int num_compared = 0;
  for (SeededRandom& random : Seeds(60)) {
    const HierarchyData levels = walk_levels(random, 1.0);
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    double last = 0.0;
    int last_level = -1;
    for (double flops = 0.0; flops < 4e5; flops += 4e3) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy);
      if (solution.status == SolveStatus::optimal) break;
      const double now = solution.levels[static_cast<std::size_t>(solution.failed_level)].residual;
      const bool is_same_level = solution.failed_level == last_level;
      ASSERT_TRUE(!is_same_level || now <= last + kTolerance * (1.0 + last));
      num_compared += is_same_level ? 1 : 0;
      last = now;
      last_level = solution.failed_level;
    }
  }
  EXPECT_GT(num_compared, 100);
}

/// More than one sweep or one step costs: all rows, and the rows that tell where y is, through all
/// columns.
double largest_piece(const Hierarchy& hierarchy) {
  double rows = static_cast<double>(kUnknowns);
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    rows += static_cast<double>(hierarchy.level(k).num_rows());
  }
  return 12.0 * rows * kUnknowns * kUnknowns;
}

TEST(Budget, IsKeptButForTheLeadingEqualitiesAndWhatHadBegun) {
  int num_early = 0;
  for (SeededRandom& random : Seeds(60)) {
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, walk_levels(random, 1.0));
    LexicographicSolver none(hierarchy, with_flops(0.0));
    ASSERT_EQ(none.solve(hierarchy).status, SolveStatus::iteration_cap);
    ASSERT_EQ(none.num_sweeps(), 0);
    const double least = none.flops();
    const double all = [&] {
      LexicographicSolver solver(hierarchy);
      (void)solver.solve(hierarchy);
      return solver.flops();
    }();
    for (double flops = 0.0; flops < 2.0 * all; flops += 0.05 * all) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy);
      ASSERT_LE(solver.flops(), std::max(flops, least) + largest_piece(hierarchy));
      const bool ended_early = solution.status == SolveStatus::iteration_cap;
      ASSERT_TRUE(!ended_early || (solver.flops() >= flops && flops <= all));
      num_early += ended_early ? 1 : 0;
    }
  }
  EXPECT_GT(num_early, 300);
}

TEST(Budget, IsKeptWhereTheCascadeWasAskedForWhichHasNone) {
  RandomMatrices random(2);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, table_one_levels(random, 3, 1.0));
  LexicographicOptions options = with_flops(1.0);
  options.max_sweeps = 0;
  EXPECT_EQ(LexicographicSolver(hierarchy, options).solve(hierarchy).status,
            SolveStatus::iteration_cap);
  options.budget.flops = 1e9;
  EXPECT_EQ(LexicographicSolver(hierarchy, options).solve(hierarchy).status, SolveStatus::optimal);
}

TEST(Budget, WhereverItEndsXIsReadInTheBasisInWhichItWasFound) {
  int num_early = 0, most_finished = 0;
  for (SeededRandom& random : Seeds(60)) {
    HierarchyData levels = walk_levels(random, 1.0);
    levels.resize(5);  // x is left open: the basis is made orthonormal on the way
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    const Substitution substitution = skew_substitution_of(levels, 2, random);
    const Solution optimum = LexicographicSolver(hierarchy).solve(hierarchy);
    for (double flops = 0.0; flops < 1e6; flops += 4e3) {
      LexicographicSolver solver(hierarchy, with_flops(flops));
      const Solution& solution = solver.solve(hierarchy, substitution);
      if (solution.status == SolveStatus::optimal) continue;
      expect_safe(hierarchy, solution, optimum);
      most_finished = std::max(most_finished, solution.failed_level);
      ++num_early;
    }
  }
  EXPECT_GT(num_early, 200);
  EXPECT_EQ(most_finished, 5);  // all, and x is not yet the shortest
}

}  // namespace
}  // namespace surefoot::solver
