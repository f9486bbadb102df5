#include "surefoot/control/hierarchy_solver.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace surefoot::control {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
const LevelTransition kNone;

/// x₀ ≤ 1 above x = (2, 3).
solver::Hierarchy limit_above_wish() {
  solver::Hierarchy hierarchy(2);
  solver::Rows limit = hierarchy.level(hierarchy.add_level("limit", 1)).add(1, 0);
  limit.A << 1.0, 0.0;
  limit.lower << -kInf;
  limit.upper << 1.0;
  solver::Rows wish = hierarchy.level(hierarchy.add_level("wish", 2)).add(2, 0);
  wish.A.setIdentity();
  wish.set_equal(0, 2.0);
  wish.set_equal(1, 3.0);
  return hierarchy;
}

/// From both levels to the second one alone.
LevelTransition limit_goes(double share) {
  LevelTransition transition;
  transition.before.set();
  transition.after.set();
  transition.after.reset(0);
  transition.share = share;
  return transition;
}

SolverOptions options_of(SolverMethod method) {
  SolverOptions options;
  options.method = method;
  return options;
}

TEST(HierarchySolver, EitherMethodFindsTheOptimum) {
  const solver::Hierarchy hierarchy = limit_above_wish();
  for (const SolverMethod method : kSolverMethods) {
    HierarchySolver solver(hierarchy, options_of(method));
    for (int tick = 0; tick < 3; ++tick) {
      const solver::Solution& solution = solver.solve(hierarchy, nullptr, kNone);
      ASSERT_EQ(solution.status, solver::SolveStatus::optimal) << name(method);
      EXPECT_TRUE(solution.x.isApprox(Eigen::Vector2d(1.0, 3.0), 1e-12)) << name(method);
    }
  }
}

TEST(HierarchySolver, ASubstitutionIsUsedByTheLexicographicMethodAlone) {
  SolverOptions options;
  EXPECT_TRUE(HierarchySolver(limit_above_wish(), options).wants_substitution());
  options.structure = false;
  EXPECT_FALSE(HierarchySolver(limit_above_wish(), options).wants_substitution());
  EXPECT_FALSE(
      HierarchySolver(limit_above_wish(), options_of(SolverMethod::cascade)).wants_substitution());

  solver::Hierarchy hierarchy(2);  // x₀ + x₁ = 2, in closed form, above x = (2, 3)
  solver::Rows sum = hierarchy.level(hierarchy.add_level("sum", 1)).add(1, 0);
  sum.A << 1.0, 1.0;
  sum.set_equal(0, 2.0);
  solver::Rows wish = hierarchy.level(hierarchy.add_level("wish", 2)).add(2, 0);
  wish.A.setIdentity();
  wish.set_equal(0, 2.0);
  wish.set_equal(1, 3.0);
  solver::Substitution substitution;
  substitution.num_levels = 1;
  substitution.basis.resize(2, 1);
  substitution.basis << 1.0, -1.0;
  substitution.offset = Eigen::Vector2d(1.0, 1.0);
  for (const SolverMethod method : kSolverMethods) {
    HierarchySolver solver(hierarchy, options_of(method));
    const solver::Solution& solution = solver.solve(hierarchy, &substitution, kNone);
    EXPECT_TRUE(solution.x.isApprox(Eigen::Vector2d(0.5, 1.5), 1e-12)) << name(method);
  }
}

TEST(HierarchySolver, DuringATransitionXLiesBetweenTheTwoOptima) {
  const solver::Hierarchy hierarchy = limit_above_wish();
  for (const SolverMethod method : kSolverMethods) {
    HierarchySolver solver(hierarchy, options_of(method));
    for (const double share : {0.0, 0.25, 1.0}) {
      const solver::Solution& solution = solver.solve(hierarchy, nullptr, limit_goes(share));
      EXPECT_NEAR(solution.x[0], 1.0 + share, 1e-12) << name(method);
      EXPECT_NEAR(solution.x[1], 3.0, 1e-12) << name(method);
    }
    EXPECT_NEAR(solver.solve(hierarchy, nullptr, kNone).x[0], 1.0, 1e-12) << "it is over";
  }
}

TEST(HierarchySolver, TellsWhatHoldsALevelBackOfAnOptimumThatTheLexicographicMethodFound) {
  const solver::Hierarchy hierarchy = limit_above_wish();
  HierarchySolver solver(hierarchy, {});
  EXPECT_TRUE(solver.blockers().empty()) << "nothing is solved yet";
  solver.solve(hierarchy, nullptr, kNone);
  const auto blockers = solver.blockers();
  ASSERT_EQ(blockers.size(), 2U);
  ASSERT_TRUE(blockers[1].is_known);
  ASSERT_EQ(blockers[1].count, 1U);
  EXPECT_EQ(blockers[1].dearest[0].at.level, 0);
  EXPECT_NEAR(blockers[1].dearest[0].cost, 1.0, 1e-12);

  solver.solve(hierarchy, nullptr, limit_goes(0.5));
  EXPECT_TRUE(solver.blockers().empty()) << "no optimum";

  HierarchySolver cascade(hierarchy, options_of(SolverMethod::cascade));
  cascade.solve(hierarchy, nullptr, kNone);
  EXPECT_TRUE(cascade.blockers().empty()) << "it does not say";
}

TEST(HierarchySolver, ABudgetOfFlopsEndsTheSearch) {
  const solver::Hierarchy hierarchy = limit_above_wish();
  SolverOptions options;
  options.budget.flops = 0.0;
  HierarchySolver solver(hierarchy, options);
  const solver::Solution& solution = solver.solve(hierarchy, nullptr, kNone);
  EXPECT_NE(solution.status, solver::SolveStatus::optimal);
  EXPECT_TRUE(solution.x.allFinite());
}

}  // namespace
}  // namespace surefoot::control
