#include "surefoot/solver/sweep.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace surefoot::solver {
namespace {

TEST(SweepKernels, TheWidestThatTheProcessorHasAreUsedUnlessOthersAreAskedFor) {
  const std::vector<const SweepKernels*> all = all_kernels();
  EXPECT_TRUE(std::ranges::is_sorted(all, std::less_equal{}, &SweepKernels::pack));
  RandomMatrices random(3);
  const Hierarchy hierarchy = make_hierarchy(30, table_one_levels(random, 3, 1.0));
  const auto x = [&](const SweepKernels* kernels) -> VectorXd {
    return LexicographicSolver(hierarchy, {.kernels = kernels}).solve(hierarchy).x;
  };
  EXPECT_EQ(x(nullptr), x(all.back()));
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NE(x(all[i]), x(all[i - 1])) << "sums in another order round otherwise";
  }
}

/// Without a last resort: what the sweeps and the search of each instruction set find themselves.
void expect_same_x(const Hierarchy& hierarchy, const VectorXd& expected) {
  for (const SweepKernels* kernels : all_kernels()) {
    SCOPED_TRACE(kernels->name);
    LexicographicSolver solver(hierarchy, {.kernels = kernels});
    const Solution& solution = solver.solve(hierarchy);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(solver.num_sweeps(), LexicographicOptions{}.max_sweeps);
    ASSERT_LE((solution.x - expected).norm(), 1e-9 * (1.0 + expected.norm()));
  }
}

TEST(SweepKernels, AllInstructionSetsGiveTheSameAnswer) {
  for (SeededRandom& random : Seeds(200)) {
    const Index n = random.integer(1, 40);
    HierarchyData levels =
        random_levels(random, {.unknowns = n, .levels = 5, .max_rows = 9, .inequality_share = 0.6});
    levels.push_back(close_to(random.vector(n)));
    const Hierarchy hierarchy = make_hierarchy(n, levels);
    expect_same_x(hierarchy, CascadeSolver(hierarchy).solve(hierarchy).x);
  }
}

TEST(SweepKernels, AllInstructionSetsAgreeOnManyActiveRows) {
  for (SeededRandom& random : Seeds(100)) {
    const Hierarchy hierarchy = make_hierarchy(30, walk_levels(random, 1.0));
    expect_same_x(hierarchy, CascadeSolver(hierarchy).solve(hierarchy).x);
  }
}

TEST(SweepKernels, AllInstructionSetsSeeNumbersThatAreNone) {
  for (const SweepKernels* kernels : all_kernels()) {
    SCOPED_TRACE(kernels->name);
    for (Index column = 0; column < 11; ++column) {
      HierarchyData levels{equalities(MatrixXd::Ones(1, 11), VectorXd::Ones(1))};
      levels[0].A(0, column) = std::numeric_limits<double>::quiet_NaN();
      const Hierarchy hierarchy = make_hierarchy(11, levels);
      LexicographicSolver solver(hierarchy, {.kernels = kernels});
      ASSERT_EQ(solver.solve(hierarchy).status, SolveStatus::invalid_input) << column;
    }
  }
}

}  // namespace
}  // namespace surefoot::solver
