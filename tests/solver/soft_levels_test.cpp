#include "surefoot/solver/soft_levels.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <string>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 8;

Hierarchy random_hierarchy(int seed) {
  RandomMatrices random(static_cast<std::uint64_t>(seed));
  HierarchyData levels = random_levels(
      random, {.unknowns = kUnknowns, .levels = 5, .max_rows = 4, .inequality_share = 0.7});
  levels.push_back(close_to(random.vector(kUnknowns)));
  return make_hierarchy(kUnknowns, levels);
}

LevelSet all_but(std::initializer_list<std::size_t> missing) {
  LevelSet set;
  set.set();
  for (const std::size_t k : missing) set.reset(k);
  return set;
}

/// From one set of the levels to another.
class Transition {
 public:
  Transition(const Hierarchy& hierarchy, const LevelSet& before, const LevelSet& after)
      : hierarchy_(hierarchy),
        soft_(hierarchy),
        before_(CascadeSolver(hierarchy).solve(soft_.select(hierarchy, before))),
        after_(CascadeSolver(hierarchy).solve(soft_.select(hierarchy, after))) {}

  const Solution& at(double share) { return soft_.between(hierarchy_, before_, after_, share); }
  [[nodiscard]] const Solution& before() const { return before_; }
  [[nodiscard]] const Solution& after() const { return after_; }

 private:
  const Hierarchy& hierarchy_;
  SoftLevels soft_;
  Solution before_, after_;
};

const LevelSet kAll = all_but({});

TEST(SoftLevels, TheEndsAreTheOptimaBeforeAndAfter) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy with = random_hierarchy(seed);
    Hierarchy without = with;
    without.level(2).clear();
    Transition transition(with, all_but({2}), kAll);
    ASSERT_LE((transition.at(0.0).x - CascadeSolver(without).solve(without).x).norm(), 1e-12);
    ASSERT_LE((transition.at(1.0).x - CascadeSolver(with).solve(with).x).norm(), 1e-12);
    ASSERT_LE((transition.at(-1.0).x - transition.before().x).norm(), 1e-12);
    ASSERT_LE((transition.at(2.0).x - transition.after().x).norm(), 1e-12);
  }
}

TEST(SoftLevels, EqualSharesMoveXEquallyFar) {
  constexpr int kSteps = 20;
  for (int seed = 0; seed < 100; ++seed) {
    const Hierarchy hierarchy = random_hierarchy(seed);
    Transition transition(hierarchy, all_but({0, 3}), all_but({1}));
    const double all = (transition.after().x - transition.before().x).norm();
    VectorXd before = transition.at(0.0).x;
    for (int i = 1; i <= kSteps; ++i) {
      const VectorXd x = transition.at(static_cast<double>(i) / kSteps).x;
      ASSERT_NEAR((x - before).norm(), all / kSteps, 1e-12 * (1.0 + all)) << "seed " << seed;
      before = x;
    }
  }
}

TEST(SoftLevels, LevelsAboveTheFirstThatChangesDoNotFeelIt) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = random_hierarchy(seed);
    Transition transition(hierarchy, all_but({2}), kAll);
    const Solution& halfway = transition.at(0.5);
    for (std::size_t k = 0; k < 2; ++k)
      ASSERT_NEAR(halfway.levels[k].residual, transition.after().levels[k].residual, 1e-9);
    Hierarchy above = hierarchy;
    for (std::size_t k = 2; k < above.num_levels(); ++k) above.level(k).clear();
    ASSERT_LE(worst_stationarity(certify(above, halfway.x)), 1e-9);
  }
}

TEST(SoftLevels, LevelsBelowAreNoWorseThanTheSharesOfBothSides) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = random_hierarchy(seed);
    Transition transition(hierarchy, all_but({2}), all_but({0}));
    for (const double share : {0.1, 0.5, 0.9}) {
      const Solution& solution = transition.at(share);
      for (std::size_t k = 3; k < hierarchy.num_levels(); ++k) {
        const double before = transition.before().levels[k].residual;
        const double after = transition.after().levels[k].residual;
        ASSERT_LE(solution.levels[k].residual, (1.0 - share) * before + share * after + 1e-9);
      }
    }
  }
}

TEST(SoftLevels, TellWhatEachRowDoes) {
  HierarchyData data;
  data.push_back({MatrixXd::Identity(2, 2), Vector2d(0.0, -1.0), Vector2d(1.0, 1.0)});
  data.push_back(equalities(MatrixXd::Identity(2, 2), Vector2d(0.0, 4.0)));
  const Hierarchy hierarchy = make_hierarchy(2, data);
  Transition transition(hierarchy, all_but({0}), kAll);  // from (0, 4) to (0, 1)
  const Solution& solution = transition.at(0.5);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_EQ(solution.levels[0].rows[0], RowState::at_lower);
  EXPECT_EQ(solution.levels[0].rows[1], RowState::above_upper);
  EXPECT_NEAR(solution.levels[0].residual, 1.5, 1e-12);
  EXPECT_EQ(solution.levels[1].rows[1], RowState::equality);
  EXPECT_NEAR(solution.levels[1].residual, 1.5, 1e-12);
}

TEST(SoftLevels, WhereOneSideFailedWhatIsBetweenFailed) {
  const Hierarchy hierarchy = random_hierarchy(1);
  SoftLevels soft(hierarchy);
  Solution good = CascadeSolver(hierarchy).solve(hierarchy), capped = good, invalid = good;
  capped.status = SolveStatus::iteration_cap;
  capped.failed_level = 3;
  invalid.status = SolveStatus::invalid_input;
  EXPECT_EQ(soft.between(hierarchy, good, capped, 0.5).status, SolveStatus::iteration_cap);
  EXPECT_EQ(soft.between(hierarchy, capped, good, 0.5).failed_level, 3);
  EXPECT_EQ(soft.between(hierarchy, invalid, capped, 0.5).status, SolveStatus::invalid_input);
  EXPECT_EQ(soft.between(hierarchy, capped, invalid, 0.5).x.norm(), 0.0);
}

TEST(SoftLevels, LevelsThatAHierarchyDoesNotHaveAreEmpty) {
  const Hierarchy all = random_hierarchy(1);
  Hierarchy few(kUnknowns);
  for (std::size_t k = 0; k < 2; ++k) {
    few.add_level(all.level(k).name(), all.level(k).num_rows());
    (void)few.level(k).add(all.level(k));
  }
  SoftLevels soft(all);
  (void)soft.select(all, kAll);
  const Hierarchy& selected = soft.select(few, kAll);
  for (std::size_t k = 2; k < selected.num_levels(); ++k)
    EXPECT_EQ(selected.level(k).num_rows(), 0);
  const Solution optimum = CascadeSolver(all).solve(all);
  (void)soft.between(all, optimum, optimum, 0.5);
  for (std::size_t k = 2; k < all.num_levels(); ++k)
    EXPECT_EQ(soft.between(few, optimum, optimum, 0.5).levels[k].num_rows, 0);
}

TEST(SoftLevels, WhatIsSaidOfAFailureIsSaidOfItsX) {
  const Hierarchy hierarchy = random_hierarchy(1);
  SoftLevels soft(hierarchy);
  const Solution good = CascadeSolver(hierarchy).solve(hierarchy);
  Solution invalid = good;
  invalid.status = SolveStatus::invalid_input;
  const Solution& solution = soft.between(hierarchy, good, invalid, 0.5);
  EXPECT_EQ(solution.x.norm(), 0.0);
  for (const LevelResult& level : solution.levels) EXPECT_EQ(level.num_rows, 0);
}

TEST(SoftLevels, AShareThatIsNoNumberStaysAtTheOptimumBefore) {
  const Hierarchy hierarchy = random_hierarchy(1);
  Transition transition(hierarchy, all_but({2}), kAll);
  EXPECT_EQ(transition.at(std::numeric_limits<double>::quiet_NaN()).x, transition.before().x);
}

}  // namespace
}  // namespace surefoot::solver
