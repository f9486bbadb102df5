#include "surefoot/solver/doubt.hpp"

#include "surefoot/solver/double_double.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/linear_algebra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

// Answers that meet the optimality conditions as far as doubles can tell, and are not optimal.

namespace surefoot::solver {
namespace {

Verdict verdict_of(Index unknowns, const HierarchyData& levels, const VectorXd& x) {
  return verdict(certify(make_hierarchy(unknowns, levels), x));
}

/// a = 0, and below it a + weak b = 1 next to an impossible c = ±1e5, in coordinates turned so
/// that no unit of unknowns tells them apart.
HierarchyData nearly_parallel(double weak, double unit = 1.0) {
  RandomMatrices random(1);
  const MatrixXd R = random.rotation(3);
  MatrixXd rows(3, 3);
  rows << 1.0, weak, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0;
  return {equalities(R.topRows(1), number(0.0)),
          equalities(unit * rows * R, unit * Vector3d(1.0, 1e5, -1e5))};
}

template <typename Solver>
class Judged : public testing::Test {};
TYPED_TEST_SUITE(Judged, Solvers);

TYPED_TEST(Judged, ADirectionThatIsTooWeakToBeUsedLeavesTheLevelNotJudged) {
  for (const double weak : {1e-11, 1e-12, 1e-13}) {
    const HierarchyData levels = nearly_parallel(weak);
    const VectorXd x = solve<TypeParam>(3, levels).x;
    ASSERT_LE(x.norm(), 1.0) << "given up";
    EXPECT_LE(optimality_error(3, levels, x), kProven) << weak;
    EXPECT_EQ(verdict_of(3, levels, x), Verdict::not_judged) << weak;
    const double weakest = certify(make_hierarchy(3, levels), x)[1].doubt.weakest;
    EXPECT_TRUE(weakest >= 0.49 * weak && weakest <= 2.01 * weak) << weakest;
  }
}

TYPED_TEST(Judged, RowsThatAreDependentOrClearlyAreNotAreJudged) {
  for (const double weak : {0.0, 1e-16, 1e-15, 1e-4, 1e-2, 1.0}) {
    const HierarchyData levels = nearly_parallel(weak);
    EXPECT_EQ(verdict_of(3, levels, solve<TypeParam>(3, levels).x), Verdict::proven) << weak;
  }
}

TYPED_TEST(Judged, DegenerateProblemsAreProven) {
  int proven = 0;
  for (SeededRandom& random : Seeds(300)) {
    const Index unknowns = random.integer(2, 6);
    const HierarchyData levels = random_levels(random, {.unknowns = unknowns,
                                                        .levels = 4,
                                                        .max_rows = 6,
                                                        .duplicate_share = 0.3,
                                                        .dependent_share = 0.2,
                                                        .zero_share = 0.05,
                                                        .tight_share = 0.7,
                                                        .integer_share = 0.7});
    const VectorXd x = solve<TypeParam>(unknowns, levels).x;
    proven += verdict_of(unknowns, levels, x) == Verdict::proven ? 1 : 0;
  }
  EXPECT_GE(proven, 299);
}

TEST(Doubt, WhatShortRowsAskForBesideForcesThatHideItInTheirRoundingIsSeen) {
  // x + y is fixed, so the long row is missed by 524288; the short one could be met.
  MatrixXd rows(2, 2);
  rows << -196608.0, -196608.0, -0.00390625, -0.005859375;
  const HierarchyData levels{
      equalities(RowVector2d(3.814697265625e-06, 3.814697265625e-06), number(3.814697265625e-06)),
      between(rows, Vector2d(327680.0, 0.00390625),
              Vector2d(327680.0, std::numeric_limits<double>::infinity()))};
  EXPECT_EQ(verdict_of(2, levels, Vector2d(-0.65685424949238070, 1.65685424949238061)),
            Verdict::not_judged);
  EXPECT_EQ(verdict_of(2, levels, Vector2d(5.0, -4.0)), Verdict::proven);
}

TEST(Doubt, ALongLimitThatIsOnlyTouchedDoesNotHoldInward) {
  // At the lower bound of a long row, while a short one that is parallel asks to go up.
  MatrixXd rows(2, 1);
  rows << 262144.0, 0.0625;
  const double infinity = std::numeric_limits<double>::infinity();
  const HierarchyData levels{
      between(rows, Vector2d(-131072.0, 0.09375), Vector2d(131072.0, infinity))};
  EXPECT_NE(verdict_of(1, levels, number(-0.5)), Verdict::proven);
  EXPECT_EQ(verdict_of(1, levels, number(0.5)), Verdict::proven);
}

TEST(Doubt, AShortRowIsSeenBesideOneThatIsManyTimesAsLong) {
  // What the long row asks for is fixed at 0 above; the short one could be met.
  for (const double length : {1e3, 1e4, 1e6}) {
    MatrixXd rows(2, 2);
    rows << length, length, 0.0, 1.0 / length;
    const HierarchyData levels{equalities(RowVector2d(1.0, 1.0), number(0.0)),
                               equalities(rows, Vector2d(length, 1.0 / length))};
    EXPECT_NE(verdict_of(2, levels, Vector2d(0.0, 0.0)), Verdict::proven) << length;
    EXPECT_EQ(verdict_of(2, levels, Vector2d(-1.0, 1.0)), Verdict::proven) << length;
  }
}

TEST(Doubt, ALimitThatIsViolatedByRoundingKeepsNothingFromMovingInwards) {
  // At the lower bound of a long row but for rounding, which a short one asks to leave.
  MatrixXd rows(2, 1);
  rows << 1048576.0, 1.0 / 1024.0;
  const HierarchyData levels{between(rows, Vector2d(1048576.0 * (1.0 + 1e-15), 3.0 / 1024.0),
                                     Vector2d(4.0 * 1048576.0, 3.0 / 1024.0))};
  EXPECT_NE(verdict_of(1, levels, number(1.0)), Verdict::proven);
  EXPECT_EQ(verdict_of(1, levels, number(3.0)), Verdict::proven);
}

TEST(Doubt, WhereSquaresAreBeyondTheRangeOfDoublesItIsInfinite) {
  const auto certificates =
      certify(make_hierarchy(1, {equalities(MatrixXd::Ones(1, 1), number(1e100))}), number(1e100));
  EXPECT_EQ(certificates[0].doubt.stationarity, std::numeric_limits<double>::infinity());
  EXPECT_EQ(verdict(certificates[0]), Verdict::not_judged);
}

TEST(Certificate, ALevelBelowOneThatIsNotProvenIsNotProvenEither) {
  HierarchyData levels = nearly_parallel(1e-13);  // the direction is left to the level below
  levels.push_back(equalities(RowVector3d(0.0, 0.0, 1.0), number(1.0)));
  const auto certificates = certify(make_hierarchy(3, levels), solve(3, levels).x);
  EXPECT_EQ(verdict(certificates[0]), Verdict::proven);
  EXPECT_EQ(verdict(certificates[1]), Verdict::not_judged);
  EXPECT_EQ(verdict(certificates[2]), Verdict::not_judged);
  EXPECT_EQ(certificates[1].rests_on, -1);
  EXPECT_EQ(certificates[2].rests_on, 1);
  const HierarchyData two{equalities(RowVector2d(1.0, 0.0), number(1.0)),
                          equalities(RowVector2d(0.0, 1.0), number(1.0))};
  const auto wrong = certify(make_hierarchy(2, two), Vector2d(0.0, 1.0));
  EXPECT_EQ(verdict(wrong[0]), Verdict::not_proven);
  EXPECT_EQ(verdict(wrong[1]), Verdict::not_judged);
}

TEST(Doubt, OfAnXSoLargeThatItsRoundingIsMoreThanWhatIsAskedForNothingIsProven) {
  for (const double weak : {1e-2, 1e-9}) {
    MatrixXd rows(2, 2);
    rows << 1.0, 1.0, 1.0, 1.0 + weak;
    const Vector2d b(0.1, 3.3);
    const VectorXd x = test::least_squares(rows, b);
    EXPECT_LE(optimality_error(2, {equalities(rows, b)}, x), kProven);
    EXPECT_EQ(verdict_of(2, {equalities(rows, b)}, x),
              weak == 1e-2 ? Verdict::proven : Verdict::not_judged);
  }
}

TEST(Doubt, TheUnitOfALevelDecidesNothing) {
  for (const double unit : {1e-90, 1e-6, 1e6, 1e90}) {
    for (const double weak : {1e-12, 1.0}) {
      const HierarchyData levels = nearly_parallel(weak, unit);
      const VectorXd x = solve(3, levels).x;
      EXPECT_EQ(verdict_of(3, levels, x), weak == 1.0 ? Verdict::proven : Verdict::not_judged)
          << unit;
    }
  }
}

TEST(Verdict, IsTheWorstOfTheLevels) {
  const LevelCertificate proven, refused{.residual = 0.0, .stationarity = 1e-7, .doubt = {}};
  const LevelCertificate doubtful{.residual = 0.0, .stationarity = 0.0, .doubt = {.residual = 1.0}};
  const LevelCertificate nothing{
      .residual = 0.0, .stationarity = 0.0, .doubt = {.stationarity = std::nan("")}};
  EXPECT_EQ(verdict(std::vector<LevelCertificate>{}), Verdict::proven);
  EXPECT_EQ(verdict({proven, doubtful}), Verdict::not_judged);
  EXPECT_EQ(verdict({doubtful, refused, proven}), Verdict::not_proven);
  EXPECT_EQ(verdict(nothing), Verdict::not_judged);
  EXPECT_EQ(verdict({.residual = 0.0, .stationarity = std::nan(""), .doubt = {}}),
            Verdict::not_proven);
}

TEST(DoubleDouble, HasThirtyDigits) {
  const DoubleDouble small(1e-20), one(1.0), three(3.0);
  EXPECT_EQ(static_cast<double>((one + small) - one), 1e-20);
  EXPECT_LE(std::abs(static_cast<double>(one / three * three - one)), 1e-31);
  for (const double number : {2.0, 0.1, 1e10, 7e-12}) {
    const DoubleDouble root = sqrt(DoubleDouble(number));
    EXPECT_LE(std::abs(static_cast<double>(root * root - DoubleDouble(number))), 1e-31 * number);
    const DoubleDouble ratio = DoubleDouble(number) / root;
    EXPECT_LE(std::abs(static_cast<double>(ratio - root)), 1e-31 * std::sqrt(number));
  }
  const DoubleDouble square = (one + small) * (one - small);
  EXPECT_EQ(static_cast<double>(square - one), 0.0) << "1e-40 is beyond it";
  EXPECT_TRUE(one < one + small && one + small > one && !(one == one + small));
  EXPECT_EQ(static_cast<double>(sqrt(DoubleDouble(0.0))), 0.0);
}

}  // namespace
}  // namespace surefoot::solver
