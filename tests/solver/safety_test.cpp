#include "surefoot/math/numbers.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace surefoot::solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

test::HierarchyData valid_levels() {
  test::RandomMatrices random(7);
  return test::random_levels(random, {.unknowns = 6, .levels = 5, .max_rows = 4});
}

template <typename Solver>
void expect_rejected(const test::HierarchyData& levels, int bad_level) {
  const Solution solution = test::solve<Solver>(6, levels);
  EXPECT_EQ(solution.status, SolveStatus::invalid_input);
  EXPECT_EQ(solution.failed_level, bad_level);
  EXPECT_EQ(solution.x, VectorXd::Zero(6));
}

template <typename Solver>
class Safety : public testing::Test {};
TYPED_TEST_SUITE(Safety, test::Solvers);

TYPED_TEST(Safety, NumbersThatAreNoneAreRejectedWhereverTheyStand) {
  for (const double poison : {kNaN, kInfinity, -kInfinity}) {
    test::HierarchyData levels = valid_levels();
    levels.insert(levels.begin() + 2, test::equalities(MatrixXd::Ones(2, 6), VectorXd::Ones(2)));
    levels[2].A(1, 4) = poison;
    expect_rejected<TypeParam>(levels, 2);
    levels[2].A(1, 4) = 0.0;
    levels[2].lower[1] = levels[2].upper[1] = poison;
    expect_rejected<TypeParam>(levels, 2);
  }
}

TYPED_TEST(Safety, NaNInOneBoundIsRejected) {
  test::HierarchyData levels = valid_levels();
  levels.push_back(
      test::between(MatrixXd::Ones(1, 6), VectorXd::Constant(1, kNaN), VectorXd::Ones(1)));
  expect_rejected<TypeParam>(levels, 5);
  levels.back() =
      test::between(MatrixXd::Ones(1, 6), VectorXd::Ones(1), VectorXd::Constant(1, kNaN));
  expect_rejected<TypeParam>(levels, 5);
}

TYPED_TEST(Safety, SwappedBoundsAreRejected) {
  test::HierarchyData levels = valid_levels();
  levels.push_back(test::between(MatrixXd::Ones(1, 6), VectorXd::Ones(1), VectorXd::Zero(1)));
  expect_rejected<TypeParam>(levels, 5);
}

TYPED_TEST(Safety, BoundsThatNothingCanMeetAreRejected) {
  test::HierarchyData levels = valid_levels();
  levels.push_back(test::between(MatrixXd::Ones(1, 6), VectorXd::Constant(1, kInfinity),
                                 VectorXd::Constant(1, kInfinity)));
  expect_rejected<TypeParam>(levels, 5);
}

TYPED_TEST(Safety, NumbersThatOverflowAreRejectedRatherThanReturned) {
  test::HierarchyData levels = valid_levels();
  levels.push_back(test::equalities(1e200 * MatrixXd::Ones(1, 6), VectorXd::Ones(1)));
  expect_rejected<TypeParam>(levels, 5);
}

/// x₁ = 1e190, and each unknown 1e9 times the one before.
test::HierarchyData growing(Index unknowns) {
  test::HierarchyData levels;
  for (Index i = 0; i < unknowns; ++i) {
    MatrixXd row = MatrixXd::Zero(1, unknowns);
    if (i > 0) row(0, i - 1) = 1.0;
    row(0, i) = i > 0 ? -1e-9 : 1e-90;
    levels.push_back(test::equalities(row, VectorXd::Constant(1, i > 0 ? 0.0 : 1e100)));
  }
  return levels;
}

TYPED_TEST(Safety, AnXThatOverflowsIsRejectedRatherThanReturned) {
  const VectorXd large = VectorXd::Constant(1, 1e150);
  const MatrixXd small = MatrixXd::Constant(1, 1, 1e-10);
  const VectorXd open = VectorXd::Constant(1, kInfinity);
  const std::vector<test::HierarchyData> all{
      {test::equalities(small, large)},
      {test::between(small, large, open)},
      {test::at_most(small, -large)},
      {test::at_most(MatrixXd::Ones(1, 1), open), test::equalities(small, large)},
      {test::between(small, large, open), test::equalities(small, -large)},
      growing(16)};
  for (const test::HierarchyData& levels : all) {
    const Index unknowns = levels[0].A.cols();
    const Solution solution = test::solve<TypeParam>(unknowns, levels);
    EXPECT_EQ(solution.status, SolveStatus::invalid_input);
    EXPECT_EQ(solution.failed_level, -1);
    EXPECT_EQ(solution.x, VectorXd::Zero(unknowns));
    EXPECT_EQ(solution.levels[0].residual, 0.0);
  }
}

TYPED_TEST(Safety, AResidualThatOverflowsIsRejectedRatherThanReturned) {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  const Solution solution =
      test::solve<TypeParam>(1, {test::equalities(one, VectorXd::Constant(1, 1e10)),
                                 test::equalities(1e150 * one, VectorXd::Zero(1))});
  EXPECT_EQ(solution.status, SolveStatus::invalid_input);
  EXPECT_EQ(solution.failed_level, -1);
  EXPECT_EQ(solution.x, VectorXd::Zero(1));
}

TYPED_TEST(Safety, NothingIsSaidOfLevelsThatAreNotThere) {
  test::HierarchyData levels = valid_levels();
  levels.push_back(test::equalities(MatrixXd::Zero(1, 6), VectorXd::Ones(1)));
  const Hierarchy all = test::make_hierarchy(6, levels);
  levels.resize(2);
  const Hierarchy few = test::make_hierarchy(6, levels);
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
  test::HierarchyData levels = valid_levels();
  levels.push_back(test::between(MatrixXd::Ones(1, 6), VectorXd::Constant(1, -kInfinity),
                                 VectorXd::Constant(1, kInfinity)));
  const Solution solution = test::solve<TypeParam>(6, levels);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_EQ(solution.levels.back().residual, 0.0);
  EXPECT_EQ(solution.levels.back().rows[0], RowState::inactive);
}

TYPED_TEST(Safety, AHierarchyBeyondTheCapacityIsRejected) {
  const Hierarchy small = test::make_hierarchy(3, {test::close_to(VectorXd::Ones(3))});
  TypeParam solver(small);
  const Hierarchy more_rows = test::make_hierarchy(
      3, {test::joined(test::close_to(VectorXd::Ones(3)), test::close_to(VectorXd::Ones(3)))});
  const Hierarchy more_levels = test::make_hierarchy(
      3, {test::close_to(VectorXd::Ones(3)), test::close_to(VectorXd::Ones(3))});
  const Hierarchy more_unknowns = test::make_hierarchy(4, {test::close_to(VectorXd::Ones(4))});
  EXPECT_EQ(solver.solve(more_rows).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(more_levels).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(more_unknowns).status, SolveStatus::invalid_input);
  EXPECT_EQ(solver.solve(small).status, SolveStatus::optimal);
}

TYPED_TEST(Safety, ASolverRecoversFromBadInput) {
  const test::HierarchyData good = valid_levels();
  test::HierarchyData bad = good;
  bad[0].A(0, 0) = kNaN;
  const Hierarchy good_hierarchy = test::make_hierarchy(6, good);
  TypeParam solver(good_hierarchy);
  const Solution before = solver.solve(good_hierarchy);
  EXPECT_EQ(solver.solve(test::make_hierarchy(6, bad)).status, SolveStatus::invalid_input);
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
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const test::HierarchyData levels = test::random_levels(
        random, {.unknowns = 8, .levels = 6, .max_rows = 6, .inequality_share = 0.8});
    const std::vector<double> optimal = test::residuals(test::solve<TypeParam>(8, levels));
    for (int cap = 1; cap <= 6; ++cap) {
      const Solution capped = test::solve<TypeParam>(8, levels, test::limited<TypeParam>(cap));
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
  for (int seed = 0; seed < 50; ++seed) {
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Hierarchy first =
        test::make_hierarchy(30, test::table_one_levels(random, 2 + seed % 3, 1.0));
    TypeParam fresh(first);
    TypeParam used(first);
    Hierarchy other(30);
    for (std::size_t k = 0; k < first.num_levels(); ++k) other.add_level("", 0);
    (void)used.solve(first);
    (void)used.solve(other);
    const VectorXd again = used.solve(first).x;
    ASSERT_EQ(again, fresh.solve(first).x) << "seed " << seed;
  }
}

TYPED_TEST(Safety, NothingIsAllocatedAfterConstruction) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Hierarchy hierarchy =
        test::make_hierarchy(30, test::table_one_levels(random, 2 + seed % 3, 1.0));
    TypeParam solver(hierarchy);
    const test::MallocCounter counter;
    (void)solver.solve(hierarchy);
    ASSERT_EQ(counter.count(), 0u);
  }
}

TYPED_TEST(Safety, NothingIsAllocatedForLargeOrInvalidProblemsEither) {
  test::RandomMatrices random(3);
  const test::HierarchyData levels = test::random_levels(random, {.unknowns = 120,
                                                                  .levels = 6,
                                                                  .max_rows = 500,
                                                                  .inequality_share = 0.9,
                                                                  .dependent_share = 0.02});
  const Hierarchy hierarchy = test::make_hierarchy(120, levels);
  test::HierarchyData poisoned_levels = levels;
  poisoned_levels[5].lower[0] = kNaN;
  const Hierarchy poisoned = test::make_hierarchy(120, poisoned_levels);
  TypeParam solver(hierarchy);
  const test::MallocCounter counter;
  (void)solver.solve(hierarchy);
  (void)solver.solve(poisoned);
  EXPECT_EQ(counter.count(), 0u);
}

TYPED_TEST(Safety, TheAllocationCounterCounts) {
  const test::MallocCounter counter;
  const VectorXd vector = VectorXd::Ones(100);
  EXPECT_GE(counter.count(), 1u);
  EXPECT_EQ(vector.sum(), 100.0);
}

}  // namespace
}  // namespace surefoot::solver
