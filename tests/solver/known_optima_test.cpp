#include "surefoot/math/numbers.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::solver {
namespace {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::RowVector3d;
using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double kExact = 1e-12;

MatrixXd one(double a) { return MatrixXd::Constant(1, 1, a); }
test::LevelData is(double b) { return test::equalities(one(1.0), test::number(b)); }
test::LevelData below(double f) { return test::at_most(one(1.0), test::number(f)); }
test::LevelData above(double f) {
  return test::between(one(1.0), test::number(f), test::number(kInfinity));
}

RowState state(const Solution& solution, std::size_t level, std::size_t row) {
  return solution.levels[level].rows[row];
}

template <typename Solver>
class KnownOptima : public testing::Test {};
TYPED_TEST_SUITE(KnownOptima, test::Solvers);

TYPED_TEST(KnownOptima, AnUndeterminedEqualityIsMetWithTheShortestX) {
  const Solution solution =
      test::solve<TypeParam>(2, {test::equalities(RowVector2d(3.0, 4.0), test::number(10.0))});
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_NEAR(solution.x[0], 1.2, kExact);
  EXPECT_NEAR(solution.x[1], 1.6, kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 1);
}

TYPED_TEST(KnownOptima, ContradictingRowsOfALevelMeetInTheirLeastSquares) {
  const Solution solution = test::solve<TypeParam>(1, {test::joined(is(1.0), is(3.0))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(2.0), kExact);
}

TYPED_TEST(KnownOptima, TheLengthOfARowIsItsWeight) {
  const Solution solution = test::solve<TypeParam>(
      1, {test::joined(is(0.0), test::equalities(one(2.0), test::number(5.0)))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(5.0), kExact);
}

TYPED_TEST(KnownOptima, ContradictingLevelsFollowTheFirst) {
  const Solution solution = test::solve<TypeParam>(1, {is(1.0), is(3.0)});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 2.0, kExact);
}

TYPED_TEST(KnownOptima, ALimitStopsALowerTask) {
  const Solution solution = test::solve<TypeParam>(1, {below(1.0), is(3.0)});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, 0.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 2.0, kExact);
  EXPECT_EQ(state(solution, 0, 0), RowState::at_upper);
  EXPECT_EQ(state(solution, 1, 0), RowState::equality);
}

TYPED_TEST(KnownOptima, ALimitBelowATaskIsViolatedAsLittleAsPossible) {
  const Solution solution =
      test::solve<TypeParam>(2, {test::equalities(RowVector2d(1.0, 1.0), test::number(4.0)),
                                 test::at_most(Matrix2d::Identity(), Vector2d(1.0, 1.0))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.x[1], 2.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, std::sqrt(2.0), kExact);
  EXPECT_EQ(state(solution, 1, 0), RowState::above_upper);
}

TYPED_TEST(KnownOptima, ABoxStopsATaskInItsCorner) {
  const test::LevelData box =
      test::between(Matrix2d::Identity(), Vector2d(-1.0, -1.0), Vector2d(1.0, 1.0));
  const Solution solution =
      test::solve<TypeParam>(2, {box, test::equalities(RowVector2d(1.0, 1.0), test::number(3.0)),
                                 test::equalities(RowVector2d(1.0, 0.0), test::number(0.0))});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 1.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 1.0, kExact);
  EXPECT_EQ(solution.levels[1].degrees_of_freedom_left, 0);
}

TYPED_TEST(KnownOptima, SeparatedIntervalsOfALevelMeetInTheMiddle) {
  const Solution solution = test::solve<TypeParam>(
      1, {test::joined(test::between(one(1.0), test::number(0.0), test::number(1.0)),
                       test::between(one(1.0), test::number(2.0), test::number(3.0)))});
  EXPECT_NEAR(solution.x[0], 1.5, kExact);
  EXPECT_EQ(state(solution, 0, 0), RowState::above_upper);
  EXPECT_EQ(state(solution, 0, 1), RowState::below_lower);
}

TYPED_TEST(KnownOptima, ALimitJustReachedStaysALimit) {
  // The first level moves x to its bound; it must not be fixed there.
  const Solution solution = test::solve<TypeParam>(1, {above(1.0), is(5.0)});
  EXPECT_NEAR(solution.x[0], 5.0, kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 1);
}

TYPED_TEST(KnownOptima, ALimitTouchedWithoutForceStaysALimit) {
  // Level 2 is met exactly at the bound of level 1, level 3 then leads away from it.
  const test::LevelData bound = test::at_most(RowVector2d(1.0, 1.0), test::number(2.0));
  const test::LevelData first = test::equalities(RowVector2d(1.0, 0.0), test::number(2.0));
  const test::LevelData away = test::equalities(RowVector2d(0.0, 1.0), test::number(-3.0));
  const Solution solution = test::solve<TypeParam>(2, {bound, first, away});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.x[1], -3.0, kExact);
}

TYPED_TEST(KnownOptima, ALimitThatPushesBackIsKeptByAllLowerLevels) {
  const test::LevelData bound = test::at_most(RowVector2d(1.0, 1.0), test::number(1.0));
  const test::LevelData task = test::equalities(Matrix2d::Identity(), Vector2d(1.0, 1.0));
  const test::LevelData away = test::equalities(RowVector2d(1.0, 0.0), test::number(0.0));
  const Solution solution = test::solve<TypeParam>(2, {bound, task, away});
  EXPECT_NEAR(solution.x[0], 0.5, kExact);
  EXPECT_NEAR(solution.x[1], 0.5, kExact);
  EXPECT_NEAR(solution.levels[2].residual, 0.5, kExact);
}

TYPED_TEST(KnownOptima, AViolatedLimitKeepsItsViolation) {
  const Solution solution =
      test::solve<TypeParam>(1, {test::joined(above(1.0), below(-1.0)), is(0.5)});
  EXPECT_NEAR(solution.x[0], 0.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(2.0), kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 0);
}

// Slacks of three levels in the wrong order are the known defect of a widely used cascade.
TYPED_TEST(KnownOptima, EveryLevelKeepsItsOwnSlack) {
  test::HierarchyData levels;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const MatrixXd row = MatrixXd::Identity(3, 3).row(i);
    const auto gap = 2.0 * static_cast<double>(i + 1);
    levels.push_back(test::joined(test::at_most(row, test::number(0.0)),
                                  test::at_most(-row, test::number(-gap))));
  }
  levels.push_back(test::equalities(MatrixXd::Identity(3, 3), VectorXd::Constant(3, 10.0)));
  const Solution solution = test::solve<TypeParam>(3, levels);
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 2.0, kExact);
  EXPECT_NEAR(solution.x[2], 3.0, kExact);
}

TYPED_TEST(KnownOptima, AnExhaustedNullSpaceFreezesX) {
  const test::LevelData all = test::equalities(Matrix2d::Identity(), Vector2d(1.0, 2.0));
  const Solution solution =
      test::solve<TypeParam>(2, {all, test::equalities(RowVector2d(1.0, 1.0), test::number(9.0)),
                                 test::at_most(RowVector2d(1.0, 0.0), test::number(0.0))});
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 0);
  EXPECT_EQ(solution.x[0], 1.0);
  EXPECT_EQ(solution.x[1], 2.0);
  EXPECT_NEAR(solution.levels[1].residual, 6.0, kExact);
  EXPECT_EQ(state(solution, 2, 0), RowState::above_upper);
}

TYPED_TEST(KnownOptima, AnInfeasibleTopLevelIsLeastSquaresAndLeavesTheRestFree) {
  const test::LevelData conflict =
      test::equalities((MatrixXd(2, 2) << 1.0, 0.0, 1.0, 0.0).finished(), Vector2d(0.0, 2.0));
  const Solution solution = test::solve<TypeParam>(
      2, {conflict, test::equalities(RowVector2d(1.0, 1.0), test::number(7.0))});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 6.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 0.0, kExact);
}

TYPED_TEST(KnownOptima, AForceBeyondTheFrictionPyramidIsProjectedOntoIt) {
  // λ = (tangential, tangential, normal), μ = 1: (3, 0, 1) → (2, 0, 2).
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1, 0, 0, -1;
  const test::LevelData cone = test::at_most(pyramid, VectorXd::Zero(5));
  const Solution solution =
      test::solve<TypeParam>(3, {cone, test::close_to(Eigen::Vector3d(3.0, 0.0, 1.0))});
  EXPECT_NEAR((solution.x - Eigen::Vector3d(2.0, 0.0, 2.0)).norm(), 0.0, kExact);
}

TYPED_TEST(KnownOptima, APullOnAFootStaysInTheApexOfItsPyramid) {
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1, 0, 0, -1;
  const test::LevelData cone = test::at_most(pyramid, VectorXd::Zero(5));
  const Solution solution =
      test::solve<TypeParam>(3, {cone, test::close_to(Eigen::Vector3d(0.2, -0.1, -4.0))});
  EXPECT_NEAR(solution.x.norm(), 0.0, kExact);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
}

}  // namespace
}  // namespace surefoot::solver
