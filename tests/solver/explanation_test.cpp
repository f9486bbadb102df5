#include "surefoot/solver/explanation.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::solver {
namespace {

std::vector<LevelExplanation> explanation(Index unknowns, const HierarchyData& levels) {
  return explain(make_hierarchy(unknowns, levels), solve(unknowns, levels).x);
}

/// A mass of 2 kg, x = (acceleration, force), a limit on the force, a wish for the acceleration.
HierarchyData pushed_mass(double wish) {
  return {equalities(RowVector2d(2.0, -1.0), number(0.0)),
          between(RowVector2d(0.0, 1.0), number(-10.0), number(10.0)),
          equalities(RowVector2d(1.0, 0.0), number(wish))};
}

TEST(Explanation, NamesTheLimitThatAWishRunsIntoAndWhatItCosts) {
  const auto levels = explanation(2, pushed_mass(8.0));
  ASSERT_EQ(levels[2].blocked_by.size(), 2u);  // the limit, then the dynamics
  const Blocker& limit = levels[2].blocked_by[0];
  EXPECT_EQ(limit.at.level, 1u);
  EXPECT_EQ(limit.at.row, 0);
  EXPECT_NEAR(levels[2].residual, 3.0, 1e-12);
  EXPECT_NEAR(limit.cost, 3.0, 1e-12);
  EXPECT_NEAR(limit.multiplier, 1.5, 1e-12);  // ½ (8 − f / 2)² by f, at f = 10
  EXPECT_EQ(levels[2].cost_of_level.size(), 2u);
  EXPECT_NEAR(levels[2].cost_of_level[1], 3.0, 1e-12);
}

TEST(Explanation, NamesTheLimitThatALongRowRunsInto) {
  MatrixXd rows(2, 2);
  rows << 1e4, 0.0, 0.0, 1.0;
  const auto levels = explanation(
      2, {at_most(RowVector2d(1.0, 0.0), number(1.0)), equalities(rows, Vector2d(10000.01, 0.0))});
  ASSERT_EQ(levels[1].blocked_by.size(), 1u);
  EXPECT_EQ(levels[1].blocked_by[0].at.level, 0u);
  EXPECT_NEAR(levels[1].blocked_by[0].multiplier, 100.0, 1e-6);
  EXPECT_NEAR(levels[1].blocked_by[0].cost, 0.01, 1e-9);
}

TEST(Explanation, IsEmptyWhereTheWishIsMet) {
  for (const LevelExplanation& level : explanation(2, pushed_mass(4.0))) {
    EXPECT_TRUE(level.blocked_by.empty());
    EXPECT_LE(level.residual, 1e-12);
  }
}

TEST(Explanation, DoesNotBlameALevelForItsOwnContradiction) {
  const MatrixXd twice = MatrixXd::Ones(2, 1);
  const auto levels = explanation(1, {equalities(twice, Vector2d(0.0, 2.0))});
  EXPECT_NEAR(levels[0].residual, std::sqrt(2.0), 1e-12);
  EXPECT_TRUE(levels[0].blocked_by.empty());
}

LevelData of_length(double length, LevelData level) {
  level.A *= length;
  level.lower *= length;
  level.upper *= length;
  return level;
}

TEST(Explanation, RowsThatSayTheSameAreTakenAwayTogetherAndToldOnce) {
  const LevelData limit = at_most(RowVector2d(0.6, 0.8), number(1.0));
  const LevelData fact = equalities(RowVector2d(0.6, 0.8), number(1.0));
  const LevelData wish = equalities(RowVector2d(0.6, 0.8), number(3.0));
  for (const LevelData& once : {limit, fact}) {
    const LevelData again = of_length(3.0, once);
    const HierarchyData above{joined(once, joined(again, once)), again};
    for (std::size_t num_above = 1; num_above <= 2; ++num_above) {
      HierarchyData levels(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(num_above));
      levels.push_back(wish);
      const LevelExplanation explained = explanation(2, levels).back();
      ASSERT_EQ(explained.blocked_by.size(), 1u);
      const DistinctBlocker& blocker = explained.blocked_by[0];
      EXPECT_EQ(blocker.at.row, 0);
      ASSERT_EQ(blocker.same.size(), num_above + 1);
      EXPECT_EQ(blocker.same[1].row, 2);
      EXPECT_EQ(blocker.same.back().level, num_above - 1);
      EXPECT_NEAR(blocker.cost, 2.0, 1e-12);
      EXPECT_NEAR(blocker.multiplier, 2.0, 1e-12);
      EXPECT_NEAR(blocker.independence, 1.0, 1e-12);
      EXPECT_NEAR(explained.cost_of_level[0], num_above == 1 ? 2.0 : 0.0, 1e-12);
    }
  }
}

// Above the wish x = 3 stand x = 1, or x = y = 1, and a limit that says no more: it holds as soon
// as they don't.
TEST(Explanation, ARowThatALimitStandsInForHasNothingOfItsOwn) {
  const auto own = [](const HierarchyData& levels) {
    const LevelExplanation explained = explanation(2, levels).back();
    EXPECT_FALSE(explained.blocked_by.empty());
    double most = 0.0;
    for (const DistinctBlocker& row : explained.blocked_by) most = std::max(most, row.independence);
    return most;
  };
  const LevelData fact = equalities(RowVector2d(1.0, 0.0), number(1.0));
  const LevelData wish = equalities(RowVector2d(1.0, 0.0), number(3.0));
  EXPECT_LT(own({fact, at_most(RowVector2d(1.0, 0.0), number(1.0)), wish}), 1e-12);
  const LevelData both = equalities(MatrixXd::Identity(2, 2), Vector2d(1.0, 1.0));
  EXPECT_LT(own({both, at_most(RowVector2d(1.0, 1.0), number(2.0)), wish}), 1e-12);
  EXPECT_NEAR(own({both, at_most(RowVector2d(1.0, 1.0), number(5.0)), wish}), 1.0, 1e-12);
}

TEST(Explanation, WhatALevelCostsThoughNoRowOfItDoesAloneIsToldWithAllThatHold) {
  const LevelExplanation explained =
      explanation(2, {equalities(MatrixXd::Identity(2, 2), Vector2d(1.0, 1.0)),
                      at_most(RowVector2d(1.0, 1.0), number(2.0)),
                      equalities(RowVector2d(1.0, 0.0), number(3.0))})
          .back();
  EXPECT_NEAR(explained.cost_of_level[0], 2.0, 1e-12);
  std::set<std::pair<std::size_t, Index>> rows;
  for (const DistinctBlocker& row : explained.blocked_by) rows.insert({row.at.level, row.at.row});
  EXPECT_TRUE(rows.contains({0, 0}) && rows.contains({0, 1})) << "x and y: without both it gains";
}

TEST(Explanation, AnEqualityTheOtherWayRoundSaysTheSame) {
  const auto levels = explanation(1, {equalities(Vector2d(1.0, -2.0), Vector2d(1.0, -2.0)),
                                      equalities(MatrixXd::Ones(1, 1), number(3.0))});
  ASSERT_EQ(levels[1].blocked_by.size(), 1u);
  EXPECT_EQ(levels[1].blocked_by[0].same.size(), 1u);
  EXPECT_NEAR(levels[1].blocked_by[0].cost, 2.0, 1e-12);
}

TEST(Explanation, RowsOfOneDirectionThatWantOtherValuesOrHaveOtherBoundsDoNotSayTheSame) {
  const MatrixXd one = MatrixXd::Ones(1, 1), twice = MatrixXd::Ones(2, 1);
  const LevelData wish = equalities(one, number(5.0));
  for (const LevelData& level :
       {equalities(twice, Vector2d(1.0, 3.0)), at_most(twice, Vector2d(1.0, 3.0)),
        between(one, number(1.0), number(1.0 + 1e-5)), at_most(twice, Vector2d(1.0, 1.0 + 1e-6))}) {
    const auto levels = explanation(1, {level, wish});
    for (const DistinctBlocker& blocker : levels[1].blocked_by) EXPECT_TRUE(blocker.same.empty());
    EXPECT_FALSE(levels[1].blocked_by.empty());
  }
}

TEST(Explanation, OfLimitsThatContradictEachOtherTheOneThatStopsTheWishHasTheCost) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double weight : {1.0, 100.0, 1e3, 7e3, 1e4}) {
    SCOPED_TRACE("weight " + std::to_string(weight));
    const LevelData limits = between(Vector2d(weight, 1.0), Vector2d(-infinity, 501.0),
                                     Vector2d(weight * 500, infinity));
    for (const double wish : {600.0, 0.0}) {
      const LevelExplanation explained =
          explanation(1, {limits, equalities(MatrixXd::Ones(1, 1), number(wish))})[1];
      const Index stops = wish == 600.0 ? 0 : 1;
      ASSERT_EQ(explained.blocked_by.size(), 2u);
      EXPECT_EQ(explained.blocked_by[0].at.row, stops);
      EXPECT_NEAR(explained.blocked_by[0].cost, explained.residual, 1e-6);
      EXPECT_FALSE(explained.blocked_by[0].would_gain);
      EXPECT_EQ(explained.blocked_by[1].at.row, 1 - stops);
      EXPECT_NEAR(explained.blocked_by[1].cost, 0.0, 1e-9);
      EXPECT_TRUE(explained.blocked_by[1].would_gain);
    }
  }
}

// The limit below is missed, and holds the other way: it explains nothing.
TEST(Explanation, OfLimitsOfTwoLevelsThatContradictEachOtherTheOneThatStopsTheWishIsNamed) {
  const LevelData motor = at_most(MatrixXd::Ones(1, 1), number(500.0));
  const LevelData grip = at_most(-MatrixXd::Ones(1, 1), number(-501.0));
  const auto wish =
      explanation(1, {motor, grip, equalities(MatrixXd::Ones(1, 1), number(600.0))})[2];
  ASSERT_FALSE(wish.blocked_by.empty());
  EXPECT_EQ(wish.blocked_by[0].at.level, 0u);
  EXPECT_NEAR(wish.blocked_by[0].cost, 100.0, 1e-9);
  EXPECT_NEAR(wish.blocked_by[0].multiplier, 100.0, 1e-9);
  EXPECT_NEAR(wish.cost_of_level[0], 100.0, 1e-9);
}

/// Limits of integers at all levels but the last, which are full of contradictions.
HierarchyData contradicting_limits(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&](int most) { return static_cast<int>(random() % (2u * most + 1u)) - most; };
  HierarchyData levels;
  for (int k = 0; k < 4; ++k) {
    MatrixXd A(2, 2);
    Vector2d bounds;
    for (Index i = 0; i < 2; ++i) {
      A.row(i) << draw(2), draw(2);
      if (A.row(i).isZero()) A(i, 0) = 1.0;
      bounds[i] = draw(4);
    }
    levels.push_back(k == 3 ? equalities(A, bounds) : at_most(A, bounds));
  }
  return levels;
}

/// Residual of a level where the rows above keep what they have at x, but for one.
double residual_without(const HierarchyData& levels, std::size_t k, const VectorXd& x,
                        RowIndex left_out) {
  HierarchyData question;
  for (std::size_t j = 0; j < k; ++j) {
    for (Index i = 0; i < levels[j].A.rows(); ++i) {
      if (j == left_out.level && i == left_out.row) continue;
      const LevelData row = at_most(
          levels[j].A.row(i), number(std::max(levels[j].upper[i], levels[j].A.row(i).dot(x))));
      question = {question.empty() ? row : joined(question[0], row)};
    }
  }
  question.push_back(levels[k]);
  return solve(2, question).levels.back().residual;
}

TEST(Explanation, EveryRowThatHasACostIsNamed) {
  int num_costly = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const HierarchyData levels = contradicting_limits(seed);
    const VectorXd x = solve(2, levels).x;
    const auto explained = explain(make_hierarchy(2, levels), x);
    for (std::size_t k = 1; k < levels.size(); ++k) {
      for (RowIndex at{0, 0}; at.level < k; at.row == 1 ? (++at.level, at.row = 0) : ++at.row) {
        const double cost = explained[k].residual - residual_without(levels, k, x, at);
        if (!(cost > 1e-6)) continue;
        ++num_costly;
        EXPECT_TRUE(std::ranges::any_of(explained[k].blocked_by,
                                        [&](const auto& blocker) {
                                          return blocker.at.level == at.level &&
                                                 blocker.at.row == at.row &&
                                                 std::abs(blocker.cost - cost) < 1e-6;
                                        }))
            << "seed " << seed << ", level " << k << ", row " << at.row << " of " << at.level;
      }
    }
  }
  EXPECT_GT(num_costly, 200);
}

TEST(Explanation, AMissedLimitAndOneThatIsMetDoNotSayTheSameWhereBothStopTheWish) {
  const LevelData above = at_most(MatrixXd::Ones(1, 1), number(500.0));
  const LevelData grip = at_most(-MatrixXd::Ones(1, 1), number(-501.0));
  const LevelData met = at_most(MatrixXd::Ones(1, 1), number(500.5));
  const auto wish = explanation(
      1, {joined(above, grip), met, equalities(MatrixXd::Ones(1, 1), number(600.0))})[2];
  for (const DistinctBlocker& blocker : wish.blocked_by) {
    EXPECT_TRUE(blocker.same.empty());
    EXPECT_NEAR(blocker.cost, 0.0, 1e-9);
  }
  const auto is_named = [&](std::size_t level) {
    return std::ranges::any_of(
        wish.blocked_by, [&](const DistinctBlocker& blocker) { return blocker.at.level == level; });
  };
  EXPECT_TRUE(is_named(0));
  EXPECT_TRUE(is_named(1));
}

TEST(Explanation, CostsAreNeitherNegativeNorMoreThanTheResidual) {
  int blocked = 0;
  for (SeededRandom& random : Seeds(100)) {
    const HierarchyData levels = random_levels(random, {.unknowns = 6, .levels = 4, .max_rows = 4});
    for (const LevelExplanation& level : explanation(6, levels)) {
      for (const Blocker& blocker : level.blocked_by) {
        ++blocked;
        ASSERT_GE(blocker.cost, 0.0);
        ASSERT_LE(blocker.cost, level.residual + 1e-12);
        ASSERT_GE(level.cost_of_level[blocker.at.level], blocker.cost - 1e-9);
      }
    }
  }
  EXPECT_GT(blocked, 100);
}

LevelData without_row(const LevelData& level, Index row) {
  std::vector<Index> kept;
  for (Index i = 0; i < level.lower.size(); ++i) {
    if (i != row) kept.push_back(i);
  }
  return {level.A(kept, Eigen::all), level.lower(kept), level.upper(kept)};
}

/// Limits and a task that x = 0 satisfies, with or without any of their rows, and wishes.
HierarchyData wishes_under_limits(RandomMatrices& random) {
  const LevelData limits =
      between(random.matrix(5, 6), -random.vector(5).cwiseAbs(), random.vector(5).cwiseAbs());
  return {limits, equalities(random.matrix(2, 6), VectorXd::Zero(2)),
          equalities(random.matrix(4, 6), 3.0 * random.vector(4))};
}

TEST(Explanation, CostsAreWhatIsGainedWithoutARow) {
  int compared = 0;
  for (SeededRandom& random : Seeds(100)) {
    const HierarchyData levels = wishes_under_limits(random);
    const LevelExplanation wishes = explanation(6, levels)[2];
    const auto gain = [&](const HierarchyData& less) {
      return wishes.residual - solve<LexicographicSolver>(6, less).levels.back().residual;
    };
    for (const Blocker& blocker : wishes.blocked_by) {
      HierarchyData less = levels;
      less[blocker.at.level] = without_row(levels[blocker.at.level], blocker.at.row);
      ASSERT_NEAR(gain(less), blocker.cost, 1e-9);
      ++compared;
    }
    for (std::size_t k = 0; k < 2; ++k) {
      HierarchyData less = levels;
      less.erase(less.begin() + static_cast<std::ptrdiff_t>(k));
      const bool is_blocked = wishes.cost_of_level[k] > 0.0;
      ASSERT_NEAR(is_blocked ? gain(less) : 0.0, wishes.cost_of_level[k], 1e-9);
      compared += is_blocked ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Explanation, ALevelWithoutBlockersDoesNoBetterAlone) {
  int num_missed = 0;
  for (SeededRandom& random : Seeds(100)) {
    HierarchyData levels = random_levels(random, {.unknowns = 6, .levels = 4, .max_rows = 4});
    levels[1] = joined(levels[1], equalities(levels[1].A, random.vector(levels[1].A.rows())));
    const auto explained = explanation(6, levels);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (!explained[k].blocked_by.empty()) continue;
      ASSERT_NEAR(explained[k].residual, solve(6, {levels[k]}).levels[0].residual, 1e-7);
      num_missed += k > 0 && explained[k].residual > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(num_missed, 0) << "by its own contradictions";
}

TEST(Explanation, MultipliersAreHowFastTheResidualFallsAsTheBoundGivesWay) {
  constexpr double kStep = 1e-5;
  int compared = 0;
  for (SeededRandom& random : Seeds(100)) {
    HierarchyData levels{at_most(random.matrix(3, 6), random.vector(3)),
                         equalities(random.matrix(5, 6), 3.0 * random.vector(5))};
    const LevelExplanation before = explanation(6, levels)[1];
    for (const Blocker& blocker : before.blocked_by) {
      levels[0].upper[blocker.at.row] += kStep;
      const double after = solve(6, levels).levels[1].residual;
      levels[0].upper[blocker.at.row] -= kStep;
      const double fall = 0.5 * (before.residual * before.residual - after * after) / kStep;
      ASSERT_NEAR(fall, blocker.multiplier, 1e-3 * (1.0 + blocker.multiplier));
      ++compared;
    }
  }
  EXPECT_GT(compared, 30);
}

TEST(Explanation, ACostThatCouldNotBeSolvedForIsNotKnown) {
  // Without the limit x would be 1e160, the square of which no double holds.
  const HierarchyData levels{
      at_most(MatrixXd::Identity(1, 1), VectorXd::Ones(1)),
      equalities(MatrixXd::Constant(1, 1, 1e-10), VectorXd::Constant(1, 1e150))};
  const auto explained = explain(make_hierarchy(1, levels), VectorXd::Ones(1));
  ASSERT_EQ(explained[1].blocked_by.size(), 1u);
  EXPECT_TRUE(std::isnan(explained[1].blocked_by[0].cost));
  EXPECT_TRUE(std::isnan(explained[1].cost_of_level[0]));
}

}  // namespace
}  // namespace surefoot::solver
