#include "surefoot/solver/even_units.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

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
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
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
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
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
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
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

TEST(EvenUnits, LeaveTheAnswerAsItIsToTheBitWhereTheyAreNotNeeded) {
  for (int seed = 0; seed < 50; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = random_levels(random, {});
    const Solution even =
        solve_in_even_units<LexicographicSolver>(make_hierarchy(8, levels), LexicographicOptions{});
    ASSERT_EQ(even.x, solve<LexicographicSolver>(8, levels).x) << "seed " << seed;
  }
}

TEST(EvenUnits, TheShortestXIsThatOfTheUnitsGiven) {
  // 1e6 a + b = 1e6: a = 1, and of (a, b) along (1, −1e6) the shortest.
  MatrixXd rows(2, 3);
  rows << 1e6, 1.0, 0.0, 0.0, 0.0, 1e-6;
  const Hierarchy hierarchy = make_hierarchy(3, {equalities(rows, Vector2d(1e6, 1e-6))});
  ASSERT_NE(even_units(hierarchy), VectorXd::Ones(3));
  const VectorXd expected = Eigen::Vector3d(1e12 / (1e12 + 1.0), 1e6 / (1e12 + 1.0), 1.0);
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
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
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
}  // namespace surefoot::test
