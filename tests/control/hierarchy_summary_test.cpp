#include "surefoot/control/hierarchy_summary.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace surefoot::control {
namespace {

/// x in the plane: x = 1, then x ≤ 0.25 (violated) and y ≤ 5, then y → 7, held at 5 by the level
/// before.
struct Example {
  Example() : hierarchy(2) {
    hierarchy.add_level("first", 1);
    hierarchy.add_level("second", 3);
    hierarchy.add_level("third", 1);
    add(0, 10, {1.0, 0.0}, 1.0, 1.0);
    add(1, 20, {1.0, 0.0}, -kInfinity, 0.25);
    add(1, 31, {0.0, 1.0}, -kInfinity, 5.0);
    add(1, 42, {0.0, 1.0}, -100.0, kInfinity);
    add(2, 50, {0.0, 1.0}, 7.0, 7.0);
    solver::CascadeSolver solver(hierarchy);
    solution = solver.solve(hierarchy);
  }
  void add(std::size_t level, int id, const Eigen::Vector2d& a, double lower, double upper) {
    solver::Rows rows = hierarchy.level(level).add(1, id);
    rows.A.row(0) = a.transpose();
    rows.lower[0] = lower;
    rows.upper[0] = upper;
  }
  solver::Hierarchy hierarchy;
  solver::Solution solution;
};

HierarchyReport stale_report() {
  HierarchyReport report;
  report.num_levels = 99;
  report.num_active = 99;
  report.levels.fill({77.0, 77, 77, 77, 77});
  report.active.fill({7, 7, 77, 7.0});
  report.num_missed = 77;
  report.missed.fill({7, 77, 7.0});
  return report;
}

TEST(HierarchySummary, TellsHowEveryLevelCameOut) {
  const Example example;
  HierarchyReport report = stale_report();
  summarise(example.solution, example.hierarchy, report);
  EXPECT_EQ(report.status, static_cast<int>(solver::SolveStatus::optimal));
  ASSERT_EQ(report.num_levels, 3);
  EXPECT_NEAR(report.levels[0].residual, 0.0, 1e-9);
  EXPECT_NEAR(report.levels[1].residual, 0.75, 1e-9);
  EXPECT_NEAR(report.levels[2].residual, 2.0, 1e-9);
  EXPECT_EQ(report.levels[0].num_rows, 1);
  EXPECT_EQ(report.levels[1].num_rows, 3);
  EXPECT_EQ(report.levels[0].degrees_of_freedom_left, 1);
  EXPECT_EQ(report.levels[3].num_rows, 0) << "no level: nothing left of the report before";
}

TEST(HierarchySummary, SaysWhereTheSolutionIsBorderline) {
  Example example;
  for (const bool is_borderline : {true, false}) {
    example.solution.borderline = is_borderline;
    HierarchyReport report = stale_report();
    summarise(example.solution, example.hierarchy, report);
    EXPECT_EQ(report.borderline, is_borderline);
  }
}

TEST(HierarchySummary, NamesTheActiveInequalitiesByTheirIds) {
  const Example example;
  HierarchyReport report = stale_report();
  summarise(example.solution, example.hierarchy, report);
  const auto state_of = [&](int level, int id) {
    for (int i = 0; i < report.num_active; ++i) {
      const ActiveRow& row = report.active[static_cast<std::size_t>(i)];
      if (row.level == level && row.id == id) return static_cast<solver::RowState>(row.state);
    }
    return solver::RowState::inactive;
  };
  EXPECT_EQ(state_of(1, 20), solver::RowState::above_upper);
  EXPECT_EQ(state_of(1, 31), solver::RowState::at_upper);
  EXPECT_EQ(state_of(1, 42), solver::RowState::inactive);
  EXPECT_EQ(state_of(0, 10), solver::RowState::inactive) << "an equality is not listed";
  EXPECT_EQ(report.num_active, report.levels[1].num_active);
  EXPECT_EQ(report.num_active, 2);
}

TEST(HierarchySummary, SaysByHowMuchARowIsBeyondItsBoundAndAnEqualityWasMissed) {
  const Example example;
  HierarchyReport report = stale_report();
  summarise(example.solution, example.hierarchy, report);
  ASSERT_EQ(report.num_active, 2);
  EXPECT_EQ(report.active[0].id, 20);
  EXPECT_NEAR(report.active[0].by, 0.75, 1e-9);
  EXPECT_EQ(report.active[1].by, 0.0) << "held at its bound";
  ASSERT_EQ(report.num_missed, 1) << "the first level's is met";
  EXPECT_EQ(report.missed[0].level, 2);
  EXPECT_EQ(report.missed[0].id, 50);
  EXPECT_NEAR(report.missed[0].by, -2.0, 1e-9);
}

TEST(HierarchySummary, ARowBelowItsLowerBoundIsBeyondItByLessThanNothing) {
  solver::Hierarchy hierarchy(1);
  hierarchy.add_level("most", 1);
  hierarchy.add_level("least", 1);
  for (const std::size_t level : {0u, 1u}) {
    solver::Rows rows = hierarchy.level(level).add(1, 0);
    rows.A(0, 0) = 1.0;
    rows.lower[0] = level == 0 ? -kInfinity : 5.0;
    rows.upper[0] = level == 0 ? 3.0 : kInfinity;
  }
  solver::CascadeSolver solver(hierarchy);
  HierarchyReport report;
  summarise(solver.solve(hierarchy), hierarchy, report);
  ASSERT_EQ(report.num_active, 2);
  EXPECT_EQ(report.active[1].state, static_cast<int>(solver::RowState::below_lower));
  EXPECT_NEAR(report.active[1].by, -2.0, 1e-9);
}

TEST(HierarchySummary, OfTheEqualitiesThatALevelMissedListsTheWorstThree) {
  solver::Hierarchy hierarchy(5);
  hierarchy.add_level("zero", 5);
  hierarchy.add_level("wish", 5);
  const Eigen::VectorXd wishes = Eigen::VectorXd{{1.0, -40.0, 0.1, 30.0, 20.0}};
  for (const std::size_t level : {0u, 1u}) {
    solver::Rows rows = hierarchy.level(level).add(5, 10);
    rows.A.setIdentity();
    for (int i = 0; i < 5; ++i) rows.set_equal(i, level == 0 ? 0.0 : wishes[i]);
  }
  solver::CascadeSolver solver(hierarchy);
  HierarchyReport report;
  summarise(solver.solve(hierarchy), hierarchy, report);
  ASSERT_EQ(report.num_missed, 3);
  EXPECT_EQ(report.missed[0].id, 11);
  EXPECT_NEAR(report.missed[0].by, 40.0, 1e-9);
  EXPECT_EQ(report.missed[1].id, 13);
  EXPECT_NEAR(report.missed[1].by, -30.0, 1e-9);
  EXPECT_EQ(report.missed[2].id, 14);
  hierarchy.level(1).rows(4).set_equal(0, 3.9);
  summarise(solver.solve(hierarchy), hierarchy, report);
  EXPECT_EQ(report.num_missed, 2) << "below a tenth of the worst";
}

TEST(HierarchySummary, ListsNoMoreRowsThanItHasPlaceFor) {
  constexpr int kRows = static_cast<int>(kMaxReportedRows) + 20;
  solver::Hierarchy hierarchy(1);
  hierarchy.add_level("many", kRows);
  solver::Rows rows = hierarchy.level(0).add(kRows, 0);
  rows.A.setOnes();
  rows.lower.setConstant(-kInfinity);
  rows.upper.setConstant(-1.0);
  solver::Solution solution;
  solution.status = solver::SolveStatus::optimal;
  solution.levels.resize(1);
  solution.levels[0].num_rows = kRows;
  solution.levels[0].rows.assign(kRows, solver::RowState::at_upper);
  HierarchyReport report = stale_report();
  summarise(solution, hierarchy, report);
  EXPECT_EQ(report.num_active, static_cast<int>(kMaxReportedRows));
  EXPECT_EQ(report.levels[0].num_active, kRows);
  EXPECT_EQ(report.active.back().id, static_cast<int>(kMaxReportedRows) - 1);
}

TEST(HierarchySummary, NamesTheRowsThatHoldALevelBackByTheirIds) {
  const Example example;
  solver::LexicographicSolver solver(example.hierarchy);
  HierarchyReport report = stale_report();
  summarise(solver.solve(example.hierarchy), example.hierarchy, report);
  EXPECT_EQ(report.failed_level, -1);
  EXPECT_FALSE(report.blocking_is_known);
  summarise_blockers(solver.blockers(), example.hierarchy, report);
  EXPECT_TRUE(report.blocking_is_known);
  ASSERT_EQ(report.num_blocking, 1);
  const BlockingRow& row = report.blocking[0];
  EXPECT_EQ(row.level, 2);
  EXPECT_EQ(row.by_level, 1);
  EXPECT_EQ(row.id, 31);
  EXPECT_NEAR(row.multiplier, 2.0, 1e-9);
  EXPECT_NEAR(row.cost, 2.0, 1e-9);
}

TEST(HierarchySummary, ListsOnlyTheDearestRowsThatHoldALevelBack) {
  const Example example;
  std::vector<solver::LevelBlockers> blockers(3);
  blockers[2] = {.is_known = true, .count = 5, .dearest = {}};
  for (std::size_t i = 0; i < 5; ++i) {
    blockers[2].dearest[i] = {{1, 1}, 1.0, i < 2 ? 2.0 : 0.1};
  }
  HierarchyReport report;
  summarise(example.solution, example.hierarchy, report);
  summarise_blockers(blockers, example.hierarchy, report);
  EXPECT_EQ(report.num_blocking, 2);
  EXPECT_FALSE(report.blocking_is_known) << "nothing is known of the first two levels";
  summarise_blockers({}, example.hierarchy, report);
  EXPECT_EQ(report.num_blocking, 0);
  EXPECT_FALSE(report.blocking_is_known);
}

TEST(HierarchySummary, OfRowsThatCostNothingAloneNamesAsManyAsOfDearOnes) {
  const Example example;
  std::vector<solver::LevelBlockers> blockers(3);
  blockers[2] = {.is_known = true, .count = 5, .dearest = {}};
  for (std::size_t i = 0; i < 5; ++i) blockers[2].dearest[i] = {{1, 1}, 1.0, 0.0};
  HierarchyReport report;
  summarise(example.solution, example.hierarchy, report);
  summarise_blockers(blockers, example.hierarchy, report);
  EXPECT_EQ(report.num_blocking, 3);
}

}  // namespace
}  // namespace surefoot::control
