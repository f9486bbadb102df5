// The time of each level, with and without a clock.

#include "surefoot/solver/soft_levels.hpp"
#include "tests/solver/guess.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/substitutions.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;
constexpr std::size_t kPhysics = 2;  // levels of equalities that come first
constexpr int kSeeds = 40;

/// Advances by a quarter at each call: sums are exact.
double ticking_clock() {
  static double now = 0.0;
  return now += 0.25;
}

LexicographicOptions with_clock() {
  LexicographicOptions options;
  options.clock = ticking_clock;
  return options;
}

double sum_of_times(const Solution& solution) {
  double sum = 0.0;
  for (const LevelResult& level : solution.levels) sum += level.time;
  return sum;
}

HierarchyData random_case(int seed) {
  RandomMatrices random(static_cast<std::uint64_t>(seed));
  return table_one_levels(random, seed % 5, 0.25 * (seed % 5));
}

void expect_same_bits(const Solution& timed, const Solution& silent) {
  ASSERT_EQ(timed.status, silent.status);
  ASSERT_EQ(timed.x, silent.x);
  for (std::size_t k = 0; k < silent.levels.size(); ++k) {
    ASSERT_EQ(timed.levels[k].residual, silent.levels[k].residual);
    ASSERT_EQ(timed.levels[k].rows, silent.levels[k].rows);
    ASSERT_EQ(timed.levels[k].iterations, silent.levels[k].iterations);
    ASSERT_EQ(timed.levels[k].degrees_of_freedom_left, silent.levels[k].degrees_of_freedom_left);
    ASSERT_EQ(silent.levels[k].time, 0.0);
  }
  ASSERT_EQ(silent.time, 0.0);
}

/// Those of the levels behind the physics that the search can come to.
void expect_times_within_the_whole(const Solution& solution) {
  for (std::size_t k = 0; k < solution.levels.size(); ++k) {
    ASSERT_EQ(solution.levels[k].time > 0.0, k >= kPhysics) << "level " << k;
  }
  ASSERT_LE(sum_of_times(solution), solution.time);
}

TEST(LevelTime, OfEachLevelIsAShareOfTheWholeColdAndWarm) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyData levels = random_case(seed);
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    LexicographicSolver solver(hierarchy, with_clock());
    for (int solve = 0; solve < 3; ++solve) {
      expect_times_within_the_whole(solver.solve(hierarchy));
    }
  }
}

TEST(LevelTime, ChangesNothingElse) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const HierarchyData levels = random_case(seed);
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    const Substitution substitution = substitution_of(levels, kPhysics);
    LexicographicSolver timed(hierarchy, with_clock()), silent(hierarchy);
    for (int solve = 0; solve < 2; ++solve) {
      expect_same_bits(timed.solve(hierarchy), silent.solve(hierarchy));
    }
    expect_same_bits(timed.solve(hierarchy, substitution), silent.solve(hierarchy, substitution));
    expect_times_within_the_whole(timed.solution());
  }
}

TEST(LevelTime, IsSummedOverTheSweeps) {
  for (SeededRandom& random : Seeds(kSeeds)) {
    const HierarchyData levels = random_case(random.seed());
    const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
    LexicographicSolver solver(hierarchy, with_clock());
    // Once right and once random: a sweep reads the clock twice a level, for rows and optimality.
    (void)solver.solve(hierarchy);
    const Solution right = solver.solve(hierarchy);
    ASSERT_EQ(right.levels[kPhysics].time, 2.0 * 0.25 * right.levels[kPhysics].iterations);
    (void)solver.solve(make_hierarchy(
        kUnknowns, guess(levels, [&](std::size_t, Index) { return random.integer(-1, 1); })));
    const Solution& searched = solver.solve(hierarchy);
    ASSERT_GE(searched.levels[kPhysics].time, 2.0 * 0.25 * searched.levels[kPhysics].iterations);
  }
}

TEST(LevelTime, OfASingleLevelOfEqualitiesBeforeTheFirstInequalityIsKnown) {
  HierarchyData levels = random_case(3);
  levels.erase(levels.begin());
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
  LexicographicSolver solver(hierarchy, with_clock());
  const Solution& solution = solver.solve(hierarchy);
  for (const LevelResult& level : solution.levels) EXPECT_GT(level.time, 0.0);
  EXPECT_LE(sum_of_times(solution), solution.time);
}

TEST(LevelTime, WhereTheCascadeHasToSolveItIsTheCascades) {
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, random_case(4));
  LexicographicOptions options = with_clock();
  options.max_sweeps = 0;
  LexicographicSolver solver(hierarchy, options);
  const Solution& solution = solver.solve(hierarchy);
  EXPECT_FALSE(solution.is_swept);
  for (const LevelResult& level : solution.levels) EXPECT_EQ(level.time, 0.25);
  EXPECT_LE(sum_of_times(solution), solution.time);
}

TEST(LevelTime, OfLevelsThatTheBudgetLeavesOutIsZero) {
  const HierarchyData levels = random_case(9);
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, levels);
  int num_cut_short = 0;
  for (double flops = 1.0; flops < 4e5; flops *= 1.5) {
    LexicographicOptions options = with_clock();
    options.budget.flops = flops;
    options.warm_start = false;
    LexicographicSolver solver(hierarchy, options);
    const Solution& solution = solver.solve(hierarchy);
    ASSERT_LE(sum_of_times(solution), solution.time);
    if (solution.status == SolveStatus::optimal || solver.num_sweeps() > 0) continue;
    ++num_cut_short;
    for (auto k = static_cast<std::size_t>(solution.failed_level) + 1; k < levels.size(); ++k) {
      ASSERT_EQ(solution.levels[k].time, 0.0) << "level " << k;
    }
  }
  EXPECT_GT(num_cut_short, 0);
}

TEST(LevelTime, OfInputThatMakesNoSenseIsZero) {
  HierarchyData levels = random_case(2);
  const Hierarchy good = make_hierarchy(kUnknowns, levels);
  levels[4].A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const Hierarchy bad = make_hierarchy(kUnknowns, levels);
  LexicographicSolver solver(good, with_clock());
  (void)solver.solve(good);
  const Solution& solution = solver.solve(bad);
  EXPECT_EQ(solution.status, SolveStatus::invalid_input);
  EXPECT_EQ(sum_of_times(solution), 0.0);
}

TEST(LevelTime, BetweenTwoHierarchiesIsThatOfBoth) {
  const Hierarchy hierarchy = make_hierarchy(kUnknowns, random_case(4));
  LexicographicSolver before(hierarchy, with_clock()), after(hierarchy, with_clock());
  SoftLevels soft(hierarchy);
  const Solution& a = before.solve(hierarchy);
  const Solution& b = after.solve(hierarchy);
  const Solution& between = soft.between(hierarchy, a, b, 0.5);
  for (std::size_t k = 0; k < between.levels.size(); ++k) {
    EXPECT_EQ(between.levels[k].time, a.levels[k].time + b.levels[k].time);
  }
}

}  // namespace
}  // namespace surefoot::solver
