#include "surefoot/solver/hierarchy.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/extra_rows.hpp"
#include "surefoot/solver/soft_levels.hpp"
#include "surefoot/solver/weighted_levels.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::solver {
namespace {

using test::message_of;

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
  for (const Index count : {1, 2, 1000}) {
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
  EXPECT_EQ(message_of([] { Hierarchy hierarchy(-1); }),
            "a hierarchy is made for -1 unknowns; expected 0 or more");
  Hierarchy hierarchy(3);
  EXPECT_EQ(message_of([&] { hierarchy.add_level("wish", -2); }),
            "level \"wish\" is made for -2 rows; expected 0 or more");
  EXPECT_EQ(hierarchy.num_levels(), 0u);
  hierarchy.add_level("wish", 2);
  EXPECT_EQ(message_of([&] { (void)hierarchy.level(0).add(-1, 0); }),
            "-1 rows are added to level \"wish\"; expected 0 or more");
  EXPECT_EQ(hierarchy.level(0).num_rows(), 0);
}

TEST(Hierarchy, AWeightThatIsNotAboveZeroAndFiniteIsRefusedAndNothingChanges) {
  Hierarchy hierarchy = small_hierarchy();
  Rows rows = hierarchy.level(0).add(2, 0);
  fill(rows, 3.0);
  const std::vector<std::pair<double, std::string>> wrong{
      {-1e-9, "-1e-09"}, {0.0, "0"}, {std::nan(""), "nan"}, {HUGE_VAL, "inf"}};
  for (const auto& [weight, text] : wrong) {
    const std::string end = " is " + text + "; expected a finite number > 0";
    EXPECT_EQ(message_of([&] { rows.weigh(weight); }), "the weight of rows" + end);
    EXPECT_EQ(message_of([&] { rows.weigh(1, weight); }), "the weight of a row" + end);
    EXPECT_EQ(message_of([&] { add_reference(hierarchy.level(1), Vector3d::Zero(), 0, weight); }),
              "the weight of a reference" + end);
    EXPECT_EQ(message_of([&] { add_damping(hierarchy.level(1), weight, Vector3d::Zero(), 0); }),
              "damping" + end);
    EXPECT_EQ(message_of([&] { WeightedLevels levels(hierarchy, 0, {weight}); }),
              "the weight of a level" + end);
  }
  EXPECT_EQ(hierarchy.level(0).A(), MatrixXd::Constant(2, 3, 3.0));
  EXPECT_EQ(hierarchy.level(1).num_rows(), 0);
}

TEST(Hierarchy, ARowThatThereIsNotIsNeitherWeighedNorGiven) {
  Hierarchy hierarchy = small_hierarchy();
  Rows rows = hierarchy.level(0).add(1, 0);
  EXPECT_EQ(message_of([&] { rows.weigh(1, 2.0); }),
            "row 1 is weighed, counted from 0; there are 1 rows");
  EXPECT_EQ(message_of([&] { (void)hierarchy.level(0).rows(2); }),
            "rows of level \"first\" are asked for from 2 on; expected 0 to 1");
  EXPECT_EQ(hierarchy.level(0).rows(1).A.rows(), 0);
}

TEST(Hierarchy, AReferenceOfAnotherLengthIsRefused) {
  Hierarchy hierarchy = small_hierarchy();
  fill(hierarchy.level(1).add(1, 0), 1.0);
  const std::string message =
      "a reference of 2 elements for level \"second\"; expected 3, one for each unknown";
  const Vector2d reference(1.0, 2.0);
  EXPECT_EQ(message_of([&] { add_reference(hierarchy.level(1), reference, 0); }), message);
  EXPECT_EQ(message_of([&] { add_damping(hierarchy.level(1), 0.1, reference, 0); }), message);
  EXPECT_EQ(hierarchy.level(1).num_rows(), 1);
}

TEST(Hierarchy, RowsOverOtherUnknownsAreRefused) {
  Hierarchy hierarchy = small_hierarchy(), other(2);
  other.add_level("flat", 1);
  fill(other.level(0).add(1, 0), 1.0);
  EXPECT_EQ(
      message_of([&] { (void)hierarchy.level(0).add(other.level(0)); }),
      "level \"first\" has 3 unknowns and can't have the rows of level \"flat\", which has 2");
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
}  // namespace surefoot::solver
