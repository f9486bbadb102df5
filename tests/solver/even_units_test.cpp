#include "surefoot/solver/even_units.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::solver {
namespace {

/// Small integers, so that nothing is nearly dependent.
HierarchyData integer_levels(RandomMatrices& random) {
  return random_levels(random, {.unknowns = 4,
                                .levels = 3,
                                .max_rows = 3,
                                .duplicate_share = 0.2,
                                .dependent_share = 0.1,
                                .tight_share = 0.5,
                                .integer_share = 1.0});
}

/// The same over y = x / d.
HierarchyData over(HierarchyData levels, const VectorXd& d) {
  for (LevelData& level : levels) level.A = level.A * d.asDiagonal();
  return levels;
}

VectorXd random_units(RandomMatrices& random, Index unknowns, int most) {
  VectorXd d(unknowns);
  for (double& unit : d) unit = std::ldexp(1.0, random.integer(-most, most));
  return d;
}

/// Largest difference of a residual, relative to 1 + it.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
    worst = std::max(worst, std::abs(a[k] - b[k]) / (1.0 + b[k]));
  return worst;
}

TEST(EvenUnits, AreTheGivenOnesWhereTheseAreGoodEnough) {
  for (SeededRandom& random : Seeds(50)) {
    const HierarchyData walk = table_one_levels(random, random.integer(2, 4), 0.5);
    ASSERT_EQ(even_units(make_hierarchy(30, walk)), VectorXd::Ones(30));
    const HierarchyData levels = integer_levels(random);
    ASSERT_EQ(even_units(make_hierarchy(4, levels)), VectorXd::Ones(4));
  }
}

TEST(EvenUnits, AreOneWhereThereIsNothingToTell) {
  EXPECT_EQ(even_units(Hierarchy(3)), VectorXd::Ones(3));
  EXPECT_EQ(even_units(make_hierarchy(2, {equalities(MatrixXd::Zero(2, 2), Vector2d::Zero())})),
            VectorXd::Ones(2));
  EXPECT_EQ(even_units(make_hierarchy(2, {equalities(RowVector2d(1e-30, kNaN), number(1.0))})),
            VectorXd::Ones(2));
}

TEST(EvenUnits, UndoThoseOfTheColumns) {
  for (const Index sign : {-1, 1}) {
    const Vector2d d(std::ldexp(1.0, static_cast<int>(20 * sign)), 1.0);
    MatrixXd rows(2, 2);
    rows << 1.0, 1.0, 1.0, -1.0;
    const VectorXd units = even_units(make_hierarchy(2, over({equalities(rows, d)}, d)));
    EXPECT_EQ(units[0] * d[0], units[1] * d[1]);
    EXPECT_EQ(units[0] * units[1], 1.0);
  }
}

TEST(EvenUnits, GiveTheOptimumWhateverTheUnitsOfTheUnknowns) {
  double worst_as_given = 0.0;
  for (SeededRandom& random : Seeds(500)) {
    const HierarchyData levels = integer_levels(random);
    const std::vector<double> expected = residuals(solve<LexicographicSolver>(4, levels));
    const HierarchyData given = over(levels, random_units(random, 4, 20));
    const Hierarchy hierarchy = make_hierarchy(4, given);
    const Solution swept =
        solve_in_even_units<LexicographicSolver>(hierarchy, LexicographicOptions{});
    const Solution cascade = solve_in_even_units<CascadeSolver>(hierarchy, CascadeOptions{});
    ASSERT_EQ(swept.status, SolveStatus::optimal);
    ASSERT_EQ(swept.levels.size(), levels.size());
    ASSERT_LE(difference(residuals(swept), expected), 1e-9);
    ASSERT_LE(difference(residuals(cascade), expected), 1e-9);
    ASSERT_LE(optimality_error(4, given, swept.x), kProven);
    worst_as_given = std::max(
        worst_as_given, difference(residuals(solve<LexicographicSolver>(4, given)), expected));
  }
  EXPECT_GE(worst_as_given, 1e-2) << "units matter";
}

template <typename Solver>
Solution solve_evenly(Index unknowns, const HierarchyData& levels) {
  return solve_in_even_units<Solver>(make_hierarchy(unknowns, levels), Options<Solver>{});
}

template <typename Solver>
class InEvenUnits : public testing::Test {};
TYPED_TEST_SUITE(InEvenUnits, Solvers);

TYPED_TEST(InEvenUnits, ALowerLevelDoesNotChangeAHigherResidual) {
  int num_uneven = 0;
  for (SeededRandom& random : Seeds(1000)) {
    HierarchyData levels = integer_levels(random);
    const VectorXd d = random_units(random, 4, 12);
    for (LevelData& level : levels)  // some in these units, some not
      level.A = level.A * (random.chance(0.7) ? d : VectorXd::Ones(4)).asDiagonal();
    num_uneven += even_units(make_hierarchy(4, levels)) == VectorXd::Ones(4) ? 0 : 1;
    const Solution all = solve_evenly<TypeParam>(4, levels);
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
      const HierarchyData part(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(k) + 1);
      const double residual = solve_evenly<TypeParam>(4, part).levels[k].residual;
      ASSERT_NEAR(all.levels[k].residual, residual, 1e-6 * (1.0 + residual)) << "level " << k;
    }
  }
  EXPECT_GE(num_uneven, 200);
}

// [A | e A] with e from 1e-4 to 1e-14, and a level below over unknowns of like sizes.
TYPED_TEST(InEvenUnits, ALowerLevelOfOtherUnitsDoesNotChangeAHigherResidual) {
  for (SeededRandom& random : Seeds(3000)) {
    const auto integer = [&] { return static_cast<double>(random.integer(-2, 2)); };
    const double small = std::ldexp(1.0, -random.integer(13, 46));
    const MatrixXd A{{integer(), small * integer()}, {integer(), small * integer()}};
    const HierarchyData above{equalities(A, Vector2d(integer(), integer()))};
    const HierarchyData levels{above[0],
                               equalities(RowVector2d(integer(), integer()), number(1.0))};
    const double residual = solve_evenly<TypeParam>(2, above).levels[0].residual;
    ASSERT_NEAR(solve_evenly<TypeParam>(2, levels).levels[0].residual, residual,
                1e-6 * (1.0 + residual));
  }
}

TYPED_TEST(InEvenUnits, ALowerLevelDoesNotChangeARankThatHangsOnTheUnit) {
  for (const double small : {2e-14, 1e-11}) {
    const LevelData level = equalities(MatrixXd{{-1.0, -small}, {2.0, small}}, Vector2d(3.0, 2.0));
    for (const RowVector2d& below : {RowVector2d(1.0, -1.0), RowVector2d(0.0, 1.0)}) {
      const HierarchyData levels{level, equalities(below, number(1.0))};
      const Solution all =
          solve_in_even_units<TypeParam>(make_hierarchy(2, levels), Options<TypeParam>{});
      EXPECT_LE(all.levels[0].residual, 1e-9);
      EXPECT_NEAR(all.x[1] * small, -8.0, 1e-9);
    }
  }
}

/// Each level's rank hangs on the unit of an unknown that the next one knows, too.
HierarchyData chain_of_ranks(Index unknowns) {
  const double small = std::ldexp(1.0, -45);
  HierarchyData levels;
  for (Index j = 0; j + 1 < unknowns; ++j) {
    MatrixXd A = MatrixXd::Zero(2, unknowns);
    A.block(0, j, 2, 2) << -1.0, -small, 2.0, small;
    levels.push_back(equalities(A, Vector2d(-1.0 - small, 2.0 + small)));
  }
  return levels;
}

TYPED_TEST(InEvenUnits, ManyLevelsThatEachMoveAUnitDoNotChangeAHigherResidual) {
  for (const Index unknowns : {5, 8, 16, 30}) {
    const HierarchyData levels = chain_of_ranks(unknowns);
    const VectorXd units = even_units(make_hierarchy(unknowns, levels));
    EXPECT_LE(units.array().log2().abs().maxCoeff(), 100.0) << unknowns;
    const Solution solution = solve_evenly<TypeParam>(unknowns, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal) << unknowns;
    EXPECT_LE(solution.levels[0].residual, 1e-9) << unknowns;
  }
}

TYPED_TEST(InEvenUnits, AnOrthogonalChangeOfUnknownsCarriesOver) {
  for (SeededRandom& random : Seeds(200)) {
    HierarchyData levels = random_levels(random, {.unknowns = 6});
    levels.push_back(close_to(random.vector(6)));
    const MatrixXd Q = random.rotation(6);
    const Options<TypeParam> options{};
    HierarchyData turned = over(levels, random_units(random, 6, 4));
    const Solution before = solve_in_even_units<TypeParam>(make_hierarchy(6, turned), options);
    for (LevelData& level : turned) level.A = level.A * Q.transpose();
    const Solution after = solve_in_even_units<TypeParam>(make_hierarchy(6, turned), options);
    ASSERT_LE((after.x - Q * before.x).norm(), 1e-7 * (1.0 + before.x.norm()));
  }
}

TEST(EvenUnits, AreThoseThatARankAboveHangsOn) {
  const LevelData above = equalities(MatrixXd{{-1.0, -1e-11}, {2.0, 1e-11}}, Vector2d(3.0, 2.0));
  const LevelData below = equalities(RowVector2d(1.0, -1.0), number(1.0));
  const VectorXd units = even_units(make_hierarchy(2, {above}));
  EXPECT_GE(units[1] / units[0], 1e10);
  EXPECT_EQ(even_units(make_hierarchy(2, {above, below, below, below})), units);
}

TEST(EvenUnits, AreNotThoseOfOneSmallElementThatNoRankHangsOn) {
  const LevelData above = equalities(Eigen::RowVector4d(-3.0, -2.0, 3.0, 1e-12), number(2.0));
  const LevelData below = equalities(MatrixXd{{2, 3, 3, 1}, {0, -3, -1, -3}}, Vector2d(4, -2));
  EXPECT_NE(even_units(make_hierarchy(4, {above})), VectorXd::Ones(4));
  EXPECT_EQ(even_units(make_hierarchy(4, {above, below})), VectorXd::Ones(4));
}

TEST(Certificate, SeesTheRoundingOfALevelInUnitsThatSuitOneAbove) {
  // x0 + x1 = 2 is missed by 1 / 256: in the units of the first level that is rounding.
  const double small = std::ldexp(1.0, -43);
  const Hierarchy hierarchy = make_hierarchy(
      2, {at_most(MatrixXd{{-3.0, small}, {-1.0, -small}, {-1.0, small}}, Vector3d(4.0, 2.0, 1.0)),
          equalities(RowVector2d(1.0, 1.0), number(2.0))});
  ASSERT_GE(even_units(hierarchy)[1] / even_units(hierarchy)[0], 1e10);
  EXPECT_NE(verdict(certify(hierarchy, Vector2d(1.0, 1.0 + 1.0 / 256.0))), Verdict::proven);
}

TEST(EvenUnits, AddUpOverLevelsThatEachNeedNone) {
  HierarchyData levels;
  for (Index j = 0; j < 5; ++j) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6);
    row[j] = 1.0;
    row[j + 1] = std::ldexp(1.0, -11);
    levels.push_back(equalities(row, number(1.0)));
  }
  const VectorXd units = even_units(make_hierarchy(6, levels));
  EXPECT_GE(units.maxCoeff() / units.minCoeff(), std::ldexp(1.0, 40));
}

TEST(EvenUnits, LeaveTheAnswerAsItIsToTheBitWhereTheyAreNotNeeded) {
  for (SeededRandom& random : Seeds(50)) {
    const HierarchyData levels = random_levels(random, {});
    const Solution even =
        solve_in_even_units<LexicographicSolver>(make_hierarchy(8, levels), LexicographicOptions{});
    ASSERT_EQ(even.x, solve<LexicographicSolver>(8, levels).x);
  }
}

TEST(EvenUnits, TheShortestXIsThatOfTheUnitsGiven) {
  // 1e6 a + b = 1e6: a = 1, and of (a, b) along (1, −1e6) the shortest.
  MatrixXd rows(2, 3);
  rows << 1e6, 1.0, 0.0, 0.0, 0.0, 1e-6;
  const Hierarchy hierarchy = make_hierarchy(3, {equalities(rows, Vector2d(1e6, 1e-6))});
  ASSERT_NE(even_units(hierarchy), VectorXd::Ones(3));
  const VectorXd expected = Vector3d(1e12 / (1e12 + 1.0), 1e6 / (1e12 + 1.0), 1.0);
  const Solution swept =
      solve_in_even_units<LexicographicSolver>(hierarchy, LexicographicOptions{});
  EXPECT_LE((swept.x - expected).norm(), 1e-9);
  EXPECT_EQ(swept.levels.size(), 1u);
  EXPECT_LE((solve_in_even_units<CascadeSolver>(hierarchy, CascadeOptions{}).x - expected).norm(),
            1e-9);
}

TEST(EvenUnits, OfASearchThatWasCutOffTheLevelIsOneThatThereIs) {
  RandomMatrices random(1);
  const Hierarchy hierarchy =
      make_hierarchy(4, over(integer_levels(random), Eigen::Vector4d(1e6, 1.0, 1e-6, 1.0)));
  ASSERT_NE(even_units(hierarchy), VectorXd::Ones(4));
  for (double flops = 0.0; flops < 1e5; flops += 100.0) {
    LexicographicOptions options;
    options.budget.flops = flops;
    const Solution solution = solve_in_even_units<LexicographicSolver>(hierarchy, options);
    ASSERT_LE(solution.failed_level, 3);
    ASSERT_EQ(solution.levels.size(), 3u);
  }
}

TEST(EvenUnits, AnXThatIsBeyondTheRangeOfDoublesOnlyInTheUnitsGivenIsInvalidInput) {
  MatrixXd rows(2, 2);
  rows << 1e-57, 1e-50, 1e-57, -1e-50;  // x is 1e157, and what is solved for 2e153
  const Hierarchy hierarchy = make_hierarchy(2, {equalities(rows, Vector2d(1e100, 1e100))});
  ASSERT_NE(even_units(hierarchy), VectorXd::Ones(2));
  for (const Solution& solution :
       {solve_in_even_units<LexicographicSolver>(hierarchy, LexicographicOptions{}),
        solve_in_even_units<CascadeSolver>(hierarchy, CascadeOptions{})}) {
    EXPECT_EQ(solution.status, SolveStatus::invalid_input);
    EXPECT_EQ(solution.failed_level, -1);
    EXPECT_EQ(solution.x, VectorXd::Zero(2));
  }
}

TEST(Certificate, SeesWhatIsLeftToGainAmongUnknownsOfVeryDifferentUnits) {
  int num_wrong = 0;
  // In the units given 1e-8 of the longest row's length times that of x is more than all of it.
  for (SeededRandom& random : Seeds(500)) {
    const HierarchyData levels = integer_levels(random);
    const std::vector<double> expected = residuals(solve<LexicographicSolver>(4, levels));
    const HierarchyData given = over(levels, random_units(random, 4, 20));
    const Solution as_given = solve<LexicographicSolver>(4, given);
    if (difference(residuals(as_given), expected) <= 1e-6) continue;
    ++num_wrong;
    ASSERT_GE(optimality_error(4, given, as_given.x), 1e-7);
  }
  EXPECT_GE(num_wrong, 3) << "units matter";
}

}  // namespace
}  // namespace surefoot::solver
