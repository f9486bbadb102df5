#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::solver {
namespace {

constexpr double kExact = 1e-12;

MatrixXd one(double a) { return MatrixXd::Constant(1, 1, a); }
LevelData is(double b) { return equalities(one(1.0), number(b)); }
LevelData below(double f) { return at_most(one(1.0), number(f)); }
LevelData above(double f) { return between(one(1.0), number(f), number(kInfinity)); }

RowState state(const Solution& solution, std::size_t level, std::size_t row) {
  return solution.levels[level].rows[row];
}

template <typename Solver>
class KnownOptima : public testing::Test {};
TYPED_TEST_SUITE(KnownOptima, Solvers);

TYPED_TEST(KnownOptima, AnUndeterminedEqualityIsMetWithTheShortestX) {
  const Solution solution = solve<TypeParam>(2, {equalities(RowVector2d(3.0, 4.0), number(10.0))});
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_NEAR(solution.x[0], 1.2, kExact);
  EXPECT_NEAR(solution.x[1], 1.6, kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 1);
}

TYPED_TEST(KnownOptima, ContradictingRowsOfALevelMeetInTheirLeastSquares) {
  const Solution solution = solve<TypeParam>(1, {joined(is(1.0), is(3.0))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(2.0), kExact);
}

TYPED_TEST(KnownOptima, TheLengthOfARowIsItsWeight) {
  const Solution solution =
      solve<TypeParam>(1, {joined(is(0.0), equalities(one(2.0), number(5.0)))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(5.0), kExact);
}

TYPED_TEST(KnownOptima, ContradictingLevelsFollowTheFirst) {
  const Solution solution = solve<TypeParam>(1, {is(1.0), is(3.0)});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 2.0, kExact);
}

TYPED_TEST(KnownOptima, ALimitStopsALowerTask) {
  const Solution solution = solve<TypeParam>(1, {below(1.0), is(3.0)});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, 0.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 2.0, kExact);
  EXPECT_EQ(state(solution, 0, 0), RowState::at_upper);
  EXPECT_EQ(state(solution, 1, 0), RowState::equality);
}

TYPED_TEST(KnownOptima, ALimitBelowATaskIsViolatedAsLittleAsPossible) {
  const Solution solution =
      solve<TypeParam>(2, {equalities(RowVector2d(1.0, 1.0), number(4.0)),
                           at_most(Matrix2d::Identity(), Vector2d(1.0, 1.0))});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.x[1], 2.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, std::sqrt(2.0), kExact);
  EXPECT_EQ(state(solution, 1, 0), RowState::above_upper);
}

TYPED_TEST(KnownOptima, ABoxStopsATaskInItsCorner) {
  const LevelData box = between(Matrix2d::Identity(), Vector2d(-1.0, -1.0), Vector2d(1.0, 1.0));
  const Solution solution =
      solve<TypeParam>(2, {box, equalities(RowVector2d(1.0, 1.0), number(3.0)),
                           equalities(RowVector2d(1.0, 0.0), number(0.0))});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 1.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 1.0, kExact);
  EXPECT_EQ(solution.levels[1].degrees_of_freedom_left, 0);
}

TYPED_TEST(KnownOptima, SeparatedIntervalsOfALevelMeetInTheMiddle) {
  const Solution solution =
      solve<TypeParam>(1, {joined(between(one(1.0), number(0.0), number(1.0)),
                                  between(one(1.0), number(2.0), number(3.0)))});
  EXPECT_NEAR(solution.x[0], 1.5, kExact);
  EXPECT_EQ(state(solution, 0, 0), RowState::above_upper);
  EXPECT_EQ(state(solution, 0, 1), RowState::below_lower);
}

TYPED_TEST(KnownOptima, ALimitJustReachedStaysALimit) {
  // The first level moves x to its bound; it must not be fixed there.
  const Solution solution = solve<TypeParam>(1, {above(1.0), is(5.0)});
  EXPECT_NEAR(solution.x[0], 5.0, kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 1);
}

TYPED_TEST(KnownOptima, ALimitTouchedWithoutForceStaysALimit) {
  // Level 2 is met exactly at the bound of level 1, level 3 then leads away from it.
  const LevelData bound = at_most(RowVector2d(1.0, 1.0), number(2.0));
  const LevelData first = equalities(RowVector2d(1.0, 0.0), number(2.0));
  const LevelData away = equalities(RowVector2d(0.0, 1.0), number(-3.0));
  const Solution solution = solve<TypeParam>(2, {bound, first, away});
  EXPECT_NEAR(solution.x[0], 2.0, kExact);
  EXPECT_NEAR(solution.x[1], -3.0, kExact);
}

TYPED_TEST(KnownOptima, ALimitThatPushesBackIsKeptByAllLowerLevels) {
  const LevelData bound = at_most(RowVector2d(1.0, 1.0), number(1.0));
  const LevelData task = equalities(Matrix2d::Identity(), Vector2d(1.0, 1.0));
  const LevelData away = equalities(RowVector2d(1.0, 0.0), number(0.0));
  const Solution solution = solve<TypeParam>(2, {bound, task, away});
  EXPECT_NEAR(solution.x[0], 0.5, kExact);
  EXPECT_NEAR(solution.x[1], 0.5, kExact);
  EXPECT_NEAR(solution.levels[2].residual, 0.5, kExact);
}

TYPED_TEST(KnownOptima, AViolatedLimitKeepsItsViolation) {
  const Solution solution = solve<TypeParam>(1, {joined(above(1.0), below(-1.0)), is(0.5)});
  EXPECT_NEAR(solution.x[0], 0.0, kExact);
  EXPECT_NEAR(solution.levels[0].residual, std::sqrt(2.0), kExact);
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 0);
}

// Slacks of three levels in the wrong order are the known defect of a widely used cascade.
TYPED_TEST(KnownOptima, EveryLevelKeepsItsOwnSlack) {
  HierarchyData levels;
  for (Index i = 0; i < 3; ++i) {
    const MatrixXd row = MatrixXd::Identity(3, 3).row(i);
    const auto gap = 2.0 * static_cast<double>(i + 1);
    levels.push_back(joined(at_most(row, number(0.0)), at_most(-row, number(-gap))));
  }
  levels.push_back(equalities(MatrixXd::Identity(3, 3), VectorXd::Constant(3, 10.0)));
  const Solution solution = solve<TypeParam>(3, levels);
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 2.0, kExact);
  EXPECT_NEAR(solution.x[2], 3.0, kExact);
}

TYPED_TEST(KnownOptima, AnExhaustedNullSpaceFreezesX) {
  const LevelData all = equalities(Matrix2d::Identity(), Vector2d(1.0, 2.0));
  const Solution solution =
      solve<TypeParam>(2, {all, equalities(RowVector2d(1.0, 1.0), number(9.0)),
                           at_most(RowVector2d(1.0, 0.0), number(0.0))});
  EXPECT_EQ(solution.levels[0].degrees_of_freedom_left, 0);
  EXPECT_EQ(solution.x[0], 1.0);
  EXPECT_EQ(solution.x[1], 2.0);
  EXPECT_NEAR(solution.levels[1].residual, 6.0, kExact);
  EXPECT_EQ(state(solution, 2, 0), RowState::above_upper);
}

TYPED_TEST(KnownOptima, AnInfeasibleTopLevelIsLeastSquaresAndLeavesTheRestFree) {
  const LevelData conflict =
      equalities((MatrixXd(2, 2) << 1.0, 0.0, 1.0, 0.0).finished(), Vector2d(0.0, 2.0));
  const Solution solution =
      solve<TypeParam>(2, {conflict, equalities(RowVector2d(1.0, 1.0), number(7.0))});
  EXPECT_NEAR(solution.x[0], 1.0, kExact);
  EXPECT_NEAR(solution.x[1], 6.0, kExact);
  EXPECT_NEAR(solution.levels[1].residual, 0.0, kExact);
}

TYPED_TEST(KnownOptima, AForceBeyondTheFrictionPyramidIsProjectedOntoIt) {
  // λ = (tangential, tangential, normal), μ = 1: (3, 0, 1) → (2, 0, 2).
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1, 0, 0, -1;
  const LevelData cone = at_most(pyramid, VectorXd::Zero(5));
  const Solution solution = solve<TypeParam>(3, {cone, close_to(Vector3d(3.0, 0.0, 1.0))});
  EXPECT_NEAR((solution.x - Vector3d(2.0, 0.0, 2.0)).norm(), 0.0, kExact);
}

TYPED_TEST(KnownOptima, APullOnAFootStaysInTheApexOfItsPyramid) {
  MatrixXd pyramid(5, 3);
  pyramid << 1, 0, -1, -1, 0, -1, 0, 1, -1, 0, -1, -1, 0, 0, -1;
  const LevelData cone = at_most(pyramid, VectorXd::Zero(5));
  const Solution solution = solve<TypeParam>(3, {cone, close_to(Vector3d(0.2, -0.1, -4.0))});
  EXPECT_NEAR(solution.x.norm(), 0.0, kExact);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
}

}  // namespace
}  // namespace surefoot::solver
