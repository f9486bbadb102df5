// An answer that another one beats is borderline, a clear one is not.
#include "tests/solver/guess.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/damaged_bytes.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::solver {
namespace {

/// √Σ violation² of a level, but for the rounding of 64 bits.
double residual(const Level& level, const VectorXd& x) {
  long double sum = 0.0;
  for (Index i = 0; i < level.num_rows(); ++i) {
    long double value = 0.0;
    for (Index j = 0; j < x.size(); ++j)
      value += static_cast<long double>(level.A()(i, j)) * static_cast<long double>(x[j]);
    const long double above = value - static_cast<long double>(level.upper()[i]);
    const long double below = static_cast<long double>(level.lower()[i]) - value;
    const long double beyond = std::max({0.0L, above, below});
    sum += beyond * beyond;
  }
  return static_cast<double>(std::sqrt(sum));
}

/// Does another x gain in a level, and lose nothing that shows in those above?
bool is_beaten(const Hierarchy& hierarchy, const VectorXd& x, const VectorXd& other) {
  constexpr double kLost = 1e-10, kGained = 1e-6;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const Level& level = hierarchy.level(k);
    const double ours = residual(level, x), theirs = residual(level, other);
    const double unit = level.A().rowwise().norm().maxCoeff() + std::min(ours, theirs);
    if (theirs > ours + kLost * unit) return false;
    if (theirs < ours - kGained * unit) return true;
  }
  return false;
}

Hierarchy straight_legged(std::uint64_t seed) {
  RandomMatrices random(seed);
  const int feet = random.integer(2, 4);
  return make_hierarchy(30, straight_legged_levels(random, feet));
}

/// Of the cascade, with what it takes for independent as usual, sooner and later.
std::vector<VectorXd> other_answers(const Hierarchy& hierarchy) {
  std::vector<VectorXd> answers;
  for (const double tolerance : {RankTolerance{}.solve, 1e-8, 1e-12}) {
    CascadeSolver cascade(hierarchy, {.rank = {.solve = tolerance}});
    if (cascade.solve(hierarchy).status == SolveStatus::optimal)
      answers.push_back(cascade.solution().x);
  }
  return answers;
}

TEST(Borderline, AnAnswerThatIsBeatenSaysSo) {
  const int problems = test::trials(2000);
  int flagged = 0;
  for (int seed = 0; seed < problems; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = straight_legged(static_cast<std::uint64_t>(seed));
    LexicographicSolver solver(hierarchy);
    const Solution cold = solver.solve(hierarchy);
    const Solution warm = solver.solve(hierarchy);
    ASSERT_EQ(cold.status, SolveStatus::optimal);
    ASSERT_EQ(warm.status, SolveStatus::optimal);
    for (const VectorXd& other : other_answers(hierarchy)) {
      EXPECT_TRUE(cold.borderline || !is_beaten(hierarchy, cold.x, other));
      EXPECT_TRUE(warm.borderline || !is_beaten(hierarchy, warm.x, other));
    }
    flagged += cold.borderline ? 1 : 0;
  }
  EXPECT_GT(flagged, 0);
  EXPECT_LT(flagged, problems / 4) << "most are clear";
}

TEST(Borderline, TheCascadeNeverHasABetterAnswer) {
  for (int seed = 0; seed < test::trials(1000); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = straight_legged(static_cast<std::uint64_t>(seed));
    LexicographicSolver solver(hierarchy);
    CascadeSolver cascade(hierarchy);
    const VectorXd other = cascade.solve(hierarchy).x;
    EXPECT_FALSE(is_beaten(hierarchy, solver.solve(hierarchy).x, other)) << "cold";
    EXPECT_FALSE(is_beaten(hierarchy, solver.solve(hierarchy).x, other)) << "warm";
  }
}

TEST(Borderline, ClearAnswersAreNotFlagged) {
  for (SeededRandom& random : Seeds(300)) {
    const HierarchyData levels = walk_levels(random, random.uniform(0.0, 0.8));
    EXPECT_FALSE(solve<LexicographicSolver>(30, levels).borderline);
    EXPECT_FALSE(solve<CascadeSolver>(30, levels).borderline);
  }
}

/// (1, 0) x = 0 and (1, weak) x = 1, above x = 0.
HierarchyData nearly_parallel(double weak) {
  const MatrixXd A = (MatrixXd(2, 2) << 1.0, 0.0, 1.0, weak).finished();
  return {equalities(A, Vector2d(0.0, 1.0)), close_to(Vector2d::Zero())};
}

TEST(Borderline, ADirectionThatDoublesCanHardlyTellIsFlagged) {
  for (const double weak : {3e-10, 5e-11, 3e-12}) {
    EXPECT_TRUE(solve<LexicographicSolver>(2, nearly_parallel(weak)).borderline) << weak;
    EXPECT_TRUE(solve<CascadeSolver>(2, nearly_parallel(weak)).borderline) << weak;
  }
  for (const double weak : {1.0, 1e-3, 0.0}) {
    EXPECT_FALSE(solve<LexicographicSolver>(2, nearly_parallel(weak)).borderline) << weak;
    EXPECT_FALSE(solve<CascadeSolver>(2, nearly_parallel(weak)).borderline) << weak;
  }
}

TEST(Borderline, AWeakDirectionIsClearOnceTheCascadeAgreesAndABudgetLeavesNoTimeToAskIt) {
  const HierarchyData levels = nearly_parallel(1e-6);
  EXPECT_FALSE(solve<LexicographicSolver>(2, levels).borderline);
  LexicographicOptions limited;
  limited.budget.flops = 1e6;
  const Solution solution = solve<LexicographicSolver>(2, levels, limited);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_TRUE(solution.borderline);
}

TEST(Borderline, ASecondAnswerDoesNotAllocate) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Hierarchy hierarchy = straight_legged(seed);
    LexicographicSolver solver(hierarchy);
    const MallocCounter counter;
    (void)solver.solve(hierarchy);
    EXPECT_EQ(counter.count(), 0u);
  }
}

}  // namespace
}  // namespace surefoot::solver
