#include "surefoot/solver/optimality_conditions.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace surefoot::solver {
namespace {

TEST(NonNegativeLeastSquares, MeetsItsOptimalityConditions) {
  for (SeededRandom& random : Seeds(300)) {
    const Index rows = random.integer(1, 8);
    const Index columns = random.integer(1, 12);
    const MatrixXd A = random.matrix(rows, columns);
    const VectorXd b = random.vector(rows);
    const VectorXd mu = non_negative_least_squares(A, b);
    const VectorXd ascent = A.transpose() * (b - A * mu);
    ASSERT_GE(mu.minCoeff(), 0.0);
    ASSERT_LE(ascent.maxCoeff(), 1e-10);
    ASSERT_LE((ascent.array() * mu.array()).abs().maxCoeff(), 1e-10);
  }
}

TEST(NonNegativeLeastSquares, ReachesWhatLiesInTheCone) {
  for (SeededRandom& random : Seeds(300)) {
    MatrixXd A = random.matrix(6, 9);
    A.col(4) = A.col(1);
    A.col(5).setZero();
    const VectorXd b = A * random.vector(9).cwiseAbs();
    ASSERT_LE((A * non_negative_least_squares(A, b) - b).norm(), 1e-9);
  }
}

TEST(NonNegativeLeastSquares, DoesNotDependOnUnits) {
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd A = random.matrix(6, 4);
    const VectorXd b = random.vector(6);
    const double unit = std::pow(10.0, random.integer(-20, 20));
    VectorXd units(4);
    for (double& one : units) one = std::pow(10.0, random.integer(-20, 20));
    const VectorXd mu = non_negative_least_squares(A, b);
    const VectorXd scaled = non_negative_least_squares(A * units.asDiagonal(), unit * b);
    ASSERT_LE((units.cwiseProduct(scaled) / unit - mu).norm(), 1e-12);
  }
}

TEST(Multipliers, OfALimitThatIsWeakBesideWhatIsFixedAreNoMoreCertainThanTheGradient) {
  // The limit has 1e-7 independent of E; what pulls at that is rounding, or is not.
  constexpr double kWeak = 1e-7, kRounding = 1e-13;
  RowSet fixed(2);
  fixed.add(Eigen::Vector2d(1.0, 0.0), {});
  for (const double pull : {1e-14, 1e-10}) {
    RowSet touching(2);
    touching.add(Eigen::Vector2d(1.0, kWeak).normalized(), {});
    const LevelConditions level{.gradient = Eigen::Vector2d(-1.0, -pull),
                                .in_units = MatrixXd(0, 2),
                                .pull = 1.0,
                                .rounding = kRounding,
                                .fixed = RowSet(2),
                                .touching = RowSet(2)};
    const Multipliers found = multipliers(level, fixed, touching, 1e-8);
    EXPECT_NEAR(found.touching[0], pull / kWeak, 1e-6 * pull / kWeak);
    RowSet held = fixed;
    fix_pushing(found, held, touching);
    EXPECT_EQ(touching.origin.size(), pull < kRounding ? 1u : 0u) << pull;
  }
}

/// Whether a limit along the second coordinate becomes fixed, which a level with this gradient
/// pushes at; E has the first.
bool is_fixed(const Eigen::Vector3d& gradient, double rounding) {
  const LevelConditions level{.gradient = gradient,
                              .in_units = MatrixXd(0, 3),
                              .pull = 1.0,
                              .rounding = rounding,
                              .fixed = RowSet(3),
                              .touching = RowSet(3)};
  RowSet fixed(3), touching(3);
  fixed.add(Eigen::Vector3d(1.0, 0.0, 0.0), {});
  touching.add(Eigen::Vector3d(0.0, 1.0, 0.0), {});
  const Multipliers found = multipliers(level, fixed, touching, 1e-8);
  fix_pushing(found, fixed, touching);
  return touching.origin.empty();
}

TEST(Multipliers, BelowTheRoundingOfTheLevelFixNothing) {
  EXPECT_FALSE(is_fixed({0.0, -1e-11, 0.0}, 1e-10));
  EXPECT_TRUE(is_fixed({0.0, -1e-11, 0.0}, 1e-12));
}

TEST(Multipliers, BelowTheRoundingOfTheForcesBesideThemFixNothing) {
  EXPECT_FALSE(is_fixed({-1e3, -1e-12, 0.0}, 1e-20));
  EXPECT_TRUE(is_fixed({-1e-3, -1e-12, 0.0}, 1e-20));
}

TEST(Multipliers, BelowTenTimesWhatIsLeftOverFixNothing) {
  for (const double left_over : {3e-6, 3e-7})
    EXPECT_FALSE(is_fixed({0.0, -1e-6, left_over}, 1e-20)) << left_over;
  EXPECT_TRUE(is_fixed({0.0, -1e-6, 3e-8}, 1e-20));
}

TEST(LevelConditions, RoundingOfTheGradientGrowsWithX) {
  const Hierarchy hierarchy =
      make_hierarchy(2, {equalities(Eigen::RowVector2d(3.0, 4.0), VectorXd::Zero(1))});
  for (const double size : {1.0, 1e3, 1e6}) {
    const VectorXd x = size * Eigen::Vector2d(4.0, -3.0);  // which meets the row
    const double rounding = optimality_conditions(hierarchy, 0, x, 1e-8).rounding;
    const double expected =
        100.0 * std::numeric_limits<double>::epsilon() * 25.0 * (1.0 + x.norm());
    EXPECT_NEAR(rounding / expected, 1.0, 1e-12) << size;
  }
}

TEST(Independence, IsWhatNoOtherColumnHasAndZeroWhereOthersMakeIt) {
  const auto of_second = [](double b) {
    MatrixXd columns(3, 3);
    columns << 1.0, 1.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, 1.0;
    return independence(columns)[1];
  };
  for (const double b : {1.0, 1e-3, 1e-8, 1e-14}) EXPECT_NEAR(of_second(b) / b, 1.0, 1e-2) << b;
  for (const double b : {0.0, 1e-17}) EXPECT_EQ(of_second(b), 0.0) << b;
}

TEST(Independence, OfOthersDoesNotChangeWhereSomeAreDependent) {
  for (SeededRandom& random : Seeds(100)) {
    MatrixXd columns = random.matrix(8, 5);
    columns.col(4) = columns.col(1) - 2.0 * columns.col(3);
    const VectorXd found = independence(columns);
    const VectorXd without = independence(columns.leftCols(4));
    for (const Index j : {1, 3, 4}) EXPECT_EQ(found[j], 0.0) << j;
    for (const Index j : {0, 2}) EXPECT_NEAR(found[j], without[j], 1e-12) << j;
  }
}

}  // namespace
}  // namespace surefoot::solver
