#include "surefoot/solver/hierarchy.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/soft_levels.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::test {
namespace {

/// Two levels of room for two rows each, over three unknowns.
Hierarchy small_hierarchy() {
  Hierarchy hierarchy(3);
  hierarchy.add_level("first", 2);
  hierarchy.add_level("second", 2);
  return hierarchy;
}

void fill(Rows rows, double number) {
  rows.A.setConstant(number);
  rows.lower.setConstant(number);
  rows.upper.setConstant(number);
}

template <typename Solver>
class LevelCapacity : public testing::Test {};
TYPED_TEST_SUITE(LevelCapacity, Solvers);

TYPED_TEST(LevelCapacity, RowsBeyondItCanBeFilledAndAreInvalidInput) {
  Hierarchy hierarchy = small_hierarchy();
  TypeParam solver(hierarchy);
  for (const Eigen::Index count : {1, 2, 1000}) {
    hierarchy.level(0).clear();
    fill(hierarchy.level(0).add(1, 0), 1.0);
    hierarchy.level(1).clear();
    fill(hierarchy.level(1).add(2, 0), 2.0);
    EXPECT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal);
    Rows beyond = hierarchy.level(1).add(count, 7);
    ASSERT_EQ(beyond.A.rows(), count);
    ASSERT_EQ(beyond.A.norm(), 0.0);
    fill(beyond, 3.0);
    EXPECT_TRUE(hierarchy.level(1).has_overflowed());
    EXPECT_EQ(hierarchy.level(1).num_rows(), 2);
    EXPECT_EQ(hierarchy.level(1).A()(1, 2), 2.0);
    const Solution& solution = solver.solve(hierarchy);
    EXPECT_EQ(solution.status, SolveStatus::invalid_input);
    EXPECT_EQ(solution.failed_level, 1);
    EXPECT_EQ(solution.x.norm(), 0.0);
  }
  hierarchy.level(1).clear();
  EXPECT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal);
}

TYPED_TEST(LevelCapacity, ACopyOfALevelBeyondItIsInvalidToo) {
  Hierarchy large(3);
  large.add_level("first", 5);
  fill(large.level(0).add(5, 3), 1.0);
  Hierarchy hierarchy = small_hierarchy();
  TypeParam solver(hierarchy);
  (void)hierarchy.level(0).add(large.level(0));
  EXPECT_EQ(solver.solve(hierarchy).failed_level, 0);
  (void)hierarchy.level(1).add(3, 0);
  hierarchy.level(0).clear();
  SoftLevels soft(small_hierarchy());
  LevelSet all;
  all.set();
  EXPECT_EQ(solver.solve(soft.select(hierarchy, all)).failed_level, 1);
}

TEST(Hierarchy, OfLessThanNothingIsRefused) {
  EXPECT_THROW(Hierarchy(-1).add_level("wish", 2), Error);
  Hierarchy hierarchy(3);
  try {
    hierarchy.add_level("wish", -2);
    FAIL() << "no room for rows";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "level \"wish\" is made for -2 rows; expected 0 or more");
  }
  EXPECT_EQ(hierarchy.num_levels(), 0u);
}

TYPED_TEST(LevelCapacity, WithoutUnknownsEveryRowIsMissedByItsBound) {
  Hierarchy hierarchy(0);
  hierarchy.add_level("nothing to move", 2);
  TypeParam solver(hierarchy);
  fill(hierarchy.level(0).add(2, 0), 3.0);
  const Solution& solution = solver.solve(hierarchy);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_EQ(solution.x.size(), 0);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(18.0), 1e-15);
}

}  // namespace
}  // namespace surefoot::test
