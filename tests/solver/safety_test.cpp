#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace surefoot::solver {
namespace {

HierarchyData valid_levels() {
  RandomMatrices random(7);
  return random_levels(random, {.unknowns = 6, .levels = 5, .max_rows = 4});
}

template <typename Solver>
void expect_rejected(const HierarchyData& levels, int bad_level) {
  const Solution solution = solve<Solver>(6, levels);
  EXPECT_EQ(solution.status, SolveStatus::invalid_input);
  EXPECT_EQ(solution.failed_level, bad_level);
  EXPECT_EQ(solution.x, VectorXd::Zero(6));
}

template <typename Solver>
class Safety : public testing::Test {};
TYPED_TEST_SUITE(Safety, Solvers);

TYPED_TEST(Safety, NumbersThatAreNoneAreRejectedWhereverTheyStand) {
  for (const double poison : {kNaN, kInfinity, -kInfinity}) {
    HierarchyData levels = valid_levels();
    levels.insert(levels.begin() + 2, equalities(MatrixXd::Ones(2, 6), VectorXd::Ones(2)));
    levels[2].A(1, 4) = poison;
    expect_rejected<TypeParam>(levels, 2);
    levels[2].A(1, 4) = 0.0;
    levels[2].lower[1] = levels[2].upper[1] = poison;
    expect_rejected<TypeParam>(levels, 2);
  }
}

TYPED_TEST(Safety, BoundsThatMakeNoSenseAreRejected) {
  for (const auto& [lower, upper] : std::vector<std::pair<double, double>>{
           {kNaN, 1.0}, {1.0, kNaN}, {1.0, 0.0}, {kInfinity, kInfinity}}) {
    HierarchyData levels = valid_levels();
    levels.push_back(between(MatrixXd::Ones(1, 6), number(lower), number(upper)));
    expect_rejected<TypeParam>(levels, 5);
  }
}

TYPED_TEST(Safety, NumbersThatOverflowAreRejectedRatherThanReturned) {
  HierarchyData levels = valid_levels();
  levels.push_back(equalities(1e200 * MatrixXd::Ones(1, 6), VectorXd::Ones(1)));
  expect_rejected<TypeParam>(levels, 5);
}

/// x₁ = 1e190, and each unknown 1e9 times the one before.
HierarchyData growing(Index unknowns) {
  HierarchyData levels;
  for (Index i = 0; i < unknowns; ++i) {
    MatrixXd row = MatrixXd::Zero(1, unknowns);
    if (i > 0) row(0, i - 1) = 1.0;
    row(0, i) = i > 0 ? -1e-9 : 1e-90;
    levels.push_back(equalities(row, VectorXd::Constant(1, i > 0 ? 0.0 : 1e100)));
  }
  return levels;
}

TYPED_TEST(Safety, AnXThatOverflowsIsRejectedRatherThanReturned) {
  const VectorXd large = VectorXd::Constant(1, 1e150);
  const MatrixXd small = MatrixXd::Constant(1, 1, 1e-10);
  const VectorXd open = VectorXd::Constant(1, kInfinity);
  const std::vector<HierarchyData> all{
      {equalities(small, large)},
      {between(small, large, open)},
      {at_most(small, -large)},
      {at_most(MatrixXd::Ones(1, 1), open), equalities(small, large)},
      {between(small, large, open), equalities(small, -large)},
      growing(16)};
  for (const HierarchyData& levels : all) {
    const Index unknowns = levels[0].A.cols();
    const Solution solution = solve<TypeParam>(unknowns, levels);
    EXPECT_EQ(solution.status, SolveStatus::invalid_input);
    EXPECT_EQ(solution.failed_level, -1);
    EXPECT_EQ(solution.x, VectorXd::Zero(unknowns));
    EXPECT_EQ(solution.levels[0].residual, 0.0);
  }
}

TYPED_TEST(Safety, AResidualThatOverflowsIsRejectedRatherThanReturned) {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  const Solution solution = solve<TypeParam>(1, {equalities(one, VectorXd::Constant(1, 1e10)),
                                                 equalities(1e150 * one, VectorXd::Zero(1))});
  EXPECT_EQ(solution.status, SolveStatus::invalid_input);
  EXPECT_EQ(solution.failed_level, -1);
  EXPECT_EQ(solution.x, VectorXd::Zero(1));
}

TYPED_TEST(Safety, NothingIsSaidOfLevelsThatAreNotThere) {
  HierarchyData levels = valid_levels();
  levels.push_back(equalities(MatrixXd::Zero(1, 6), VectorXd::Ones(1)));
  const Hierarchy all = make_hierarchy(6, levels);
  levels.resize(2);
  const Hierarchy few = make_hierarchy(6, levels);
  TypeParam solver(all);
  (void)solver.solve(all);
  const Solution& solution = solver.solve(few);
  for (std::size_t k = 2; k < solution.levels.size(); ++k) {
    EXPECT_EQ(solution.levels[k].residual, 0.0);
    EXPECT_EQ(solution.levels[k].num_rows, 0);
    EXPECT_EQ(solution.levels[k].iterations, 0);
    EXPECT_EQ(solution.levels[k].degrees_of_freedom_left,
              solution.levels[1].degrees_of_freedom_left);
  }
}

TYPED_TEST(Safety, ARowWithoutBoundsIsAllowed) {
  HierarchyData levels = valid_levels();
  levels.push_back(between(MatrixXd::Ones(1, 6), VectorXd::Constant(1, -kInfinity),
                           VectorXd::Constant(1, kInfinity)));
  const Solution solution = solve<TypeParam>(6, levels);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_EQ(solution.levels.back().residual, 0.0);
  EXPECT_EQ(solution.levels.back().rows[0], RowState::inactive);
}

TYPED_TEST(Safety, AHierarchyBeyondTheCapacityIsRejected) {
  const Hierarchy small = make_hierarchy(3, {close_to(VectorXd::Ones(3))});
  TypeParam solver(small);
  const Hierarchy more_rows =
      make_hierarchy(3, {joined(close_to(VectorXd::Ones(3)), close_to(VectorXd::Ones(3)))});
  const Hierarchy more_levels =
      make_hierarchy(3, {close_to(VectorXd::Ones(3)), close_to(VectorXd::Ones(3))});
  const Hierarchy more_unknowns = make_hierarchy(4, {close_to(VectorXd::Ones(4))});
  EXPECT_EQ(solver.solve(more_rows).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(more_levels).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(more_unknowns).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(small).status, SolveStatus::optimal);
}

TYPED_TEST(Safety, ASolverRecoversFromBadInput) {
  const HierarchyData good = valid_levels();
  HierarchyData bad = good;
  bad[0].A(0, 0) = kNaN;
  const Hierarchy good_hierarchy = make_hierarchy(6, good);
  TypeParam solver(good_hierarchy);
  const Solution before = solver.solve(good_hierarchy);
  EXPECT_EQ(solver.solve(make_hierarchy(6, bad)).status, SolveStatus::invalid_input);
  const Solution after = solver.solve(good_hierarchy);
  EXPECT_EQ(after.status, SolveStatus::optimal);
  EXPECT_EQ(after.x, before.x);
}

TYPED_TEST(Safety, FewerRowsThanTheCapacityAreSolved) {
  Hierarchy hierarchy(2);
  hierarchy.add_level("task", 5);
  TypeParam solver(hierarchy);
  EXPECT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal);
  Rows rows = hierarchy.level(0).add(1, 0);
  rows.A << 1.0, 0.0;
  rows.set_equal(0, 3.0);
  const Solution& solution = solver.solve(hierarchy);
  EXPECT_EQ(solution.levels[0].num_rows, 1);
  EXPECT_NEAR(solution.x[0], 3.0, 1e-15);
}

TYPED_TEST(Safety, AtTheCapOfIterationsAllFinishedLevelsKeepTheirOptimum) {
  int num_capped = 0;
  for (SeededRandom& random : Seeds(300)) {
    const HierarchyData levels =
        random_levels(random, {.unknowns = 8, .levels = 6, .max_rows = 6, .inequality_share = 0.8});
    const std::vector<double> optimal = residuals(solve<TypeParam>(8, levels));
    for (int cap = 1; cap <= 6; ++cap) {
      const Solution capped = solve<TypeParam>(8, levels, limited<TypeParam>(cap));
      ASSERT_TRUE(capped.x.allFinite());
      const bool ended_early = capped.status == SolveStatus::iteration_cap;
      num_capped += ended_early ? 1 : 0;
      const auto finished =
          ended_early ? static_cast<std::size_t>(capped.failed_level) : levels.size();
      for (std::size_t k = 0; k < finished; ++k) {
        ASSERT_NEAR(capped.levels[k].residual, optimal[k], 1e-9 * (1.0 + optimal[k]));
      }
    }
  }
  EXPECT_GT(num_capped, 300);
}

TYPED_TEST(Safety, TheSameInputGivesTheSameBits) {
  for (SeededRandom& random : Seeds(50)) {
    const Hierarchy first = make_hierarchy(30, walk_levels(random, 1.0));
    TypeParam fresh(first);
    TypeParam used(first);
    Hierarchy other(30);
    for (std::size_t k = 0; k < first.num_levels(); ++k) other.add_level("", 0);
    (void)used.solve(first);
    (void)used.solve(other);
    const VectorXd again = used.solve(first).x;
    ASSERT_EQ(again, fresh.solve(first).x);
  }
}

TYPED_TEST(Safety, NothingIsAllocatedAfterConstruction) {
  for (SeededRandom& random : Seeds(30)) {
    const Hierarchy hierarchy = make_hierarchy(30, walk_levels(random, 1.0));
    const Hierarchy next = make_hierarchy(30, walk_levels(random, 0.5));
    TypeParam solver(hierarchy);
    const MallocCounter counter;
    (void)solver.solve(hierarchy);
    (void)solver.solve(next);
    ASSERT_EQ(counter.count(), 0u);
  }
}

TYPED_TEST(Safety, NothingIsAllocatedForLargeOrInvalidProblemsEither) {
  RandomMatrices random(3);
  const HierarchyData levels = random_levels(random, {.unknowns = 120,
                                                      .levels = 6,
                                                      .max_rows = 500,
                                                      .inequality_share = 0.9,
                                                      .dependent_share = 0.02});
  const Hierarchy hierarchy = make_hierarchy(120, levels);
  HierarchyData poisoned_levels = levels;
  poisoned_levels[5].lower[0] = kNaN;
  const Hierarchy poisoned = make_hierarchy(120, poisoned_levels);
  TypeParam solver(hierarchy);
  const MallocCounter counter;
  (void)solver.solve(hierarchy);
  (void)solver.solve(poisoned);
  EXPECT_EQ(counter.count(), 0u);
}

TYPED_TEST(Safety, TheAllocationCounterCounts) {
  const MallocCounter counter;
  const VectorXd vector = VectorXd::Ones(100);
  EXPECT_GE(counter.count(), 1u);
  EXPECT_EQ(vector.sum(), 100.0);
}

}  // namespace
}  // namespace surefoot::solver
