// What a solve costs at most, whatever the problem and the guess: the numbers of docs/solver.md.

#include "tests/solver/guess.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::solver {
namespace {

/// Sweeps of a solve, the last three to look for the shortest x where the cascade had to solve.
constexpr double kSweeps = 8 + 3;
/// One; one more in an orthonormal basis, and one after the cascade.
constexpr double kDescents = 3;

double rows_of(const Level& level) { return static_cast<double>(level.num_rows()); }

/// Additions and multiplications of a step in a level with so many rows, `all` with those of y.
double step_flops(double n, double rows, double all) { return n * (12.0 * all + 4.0 * rows * n); }

/// Of a descent: 20 + 2 × rows so far steps in each level, and in a last level y = 0.
double descent_flops(const Hierarchy& hierarchy) {
  const auto n = static_cast<double>(hierarchy.unknowns());
  double all = n;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) all += rows_of(hierarchy.level(k));
  double so_far = 0.0, sum = 0.0;
  for (std::size_t k = 0; k <= hierarchy.num_levels(); ++k) {
    const double rows = k < hierarchy.num_levels() ? rows_of(hierarchy.level(k)) : n;
    so_far += rows;
    sum += (20.0 + 2.0 * so_far) * step_flops(n, rows, all);
    sum += 10.0 * n * n * all;  // its rows and those that it held get columns
  }
  return sum;
}

double bound(const Hierarchy& hierarchy) {
  const auto n = static_cast<double>(hierarchy.unknowns());
  double rows = 0.0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) rows += rows_of(hierarchy.level(k));
  const double basis = 8.0 * rows * n * n + 12.0 * n * n * (n + 1.0);
  const double products = 2.0 * n * (n + 2.0) * (rows + n);
  const double sweep = 4.0 * rows * n * n + products;
  return basis + kSweeps * sweep + kDescents * (descent_flops(hierarchy) + products);
}

HierarchyData degenerate(RandomMatrices& random, Index unknowns) {
  return random_levels(random, {.unknowns = unknowns,
                                .levels = 4,
                                .max_rows = 12,
                                .inequality_share = 0.9,
                                .duplicate_share = 0.2,
                                .dependent_share = 0.1,
                                .tight_share = 0.8,
                                .integer_share = 0.8});
}

TEST(Bound, OfSweepsAndFlopsIsKeptWhateverTheGuess) {
  int most_sweeps = 0;
  for (SeededRandom& random : Seeds(1000)) {
    const Index n = random.integer(2, 12);
    const HierarchyData levels = degenerate(random, n);
    const Hierarchy hierarchy = named(n, levels);
    for (const int max_sweeps : {LexicographicOptions{}.max_sweeps, 1}) {
      LexicographicSolver solver(hierarchy, {.max_sweeps = max_sweeps});
      for (int side = -1; side <= 1; ++side) {
        const auto choose = [&](std::size_t, Index) {
          return side != 0 ? side : random.integer(-1, 1);
        };
        (void)solver.solve(named(n, guess(levels, choose)));
        ASSERT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal);
        ASSERT_LE(solver.num_sweeps(), max_sweeps + 1);
        ASSERT_LE(solver.flops(), bound(hierarchy));
        most_sweeps = std::max(most_sweeps, solver.num_sweeps());
      }
    }
  }
  EXPECT_GT(most_sweeps, 2) << "guesses were wrong";
}

TEST(Bound, OfIterationsOfTheCascadeIsKeptInEachLevel) {
  for (SeededRandom& random : Seeds(1000)) {
    const Index n = random.integer(2, 12);
    const Solution solution = solve<CascadeSolver>(n, degenerate(random, n));
    Index so_far = 0;
    for (const LevelResult& level : solution.levels) {
      so_far += level.num_rows;
      ASSERT_LE(level.iterations, 50 + 10 * so_far);
    }
  }
}

}  // namespace
}  // namespace surefoot::solver
