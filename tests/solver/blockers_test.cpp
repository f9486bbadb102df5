#include "surefoot/solver/blockers.hpp"

#include "tests/solver/solve.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace surefoot::solver {
namespace {

/// A mass of 2 kg, x = (acceleration, force), a limit on the force, a wish for the acceleration.
HierarchyData pushed_mass(double wish) {
  return {equalities(RowVector2d(2.0, -1.0), number(0.0)),
          between(RowVector2d(0.0, 1.0), number(-10.0), number(10.0)),
          equalities(RowVector2d(1.0, 0.0), number(wish))};
}

struct Solved {
  Solved(Index unknowns, const HierarchyData& levels, const LexicographicOptions& options = {})
      : hierarchy(make_hierarchy(unknowns, levels)), solver(hierarchy, options) {
    (void)solver.solve(hierarchy);
    blockers = solver.blockers();
  }
  Hierarchy hierarchy;
  LexicographicSolver solver;
  std::vector<LevelBlockers> blockers;
};

/// No leading levels: a first row that is an inequality without meaning.
HierarchyData with_a_choice(Index unknowns, HierarchyData levels) {
  MatrixXd row = MatrixXd::Ones(1, unknowns);
  levels.insert(levels.begin(), at_most(row, number(1e6)));
  return levels;
}

HierarchyData random_case(int seed) {
  RandomMatrices random(static_cast<std::uint64_t>(seed));
  return with_a_choice(
      6,
      random_levels(random, {.unknowns = 6, .levels = 4, .max_rows = 4, .inequality_share = 0.6}));
}

const Blocker* find(const LevelBlockers& level, RowIndex at) {
  const auto found = std::ranges::find_if(level.rows(), [&](const Blocker& blocker) {
    return blocker.at.level == at.level && blocker.at.row == at.row;
  });
  return found == level.rows().end() ? nullptr : &*found;
}

/// All rows above level k that can hold it are independent: then the multipliers are unique.
bool has_unique_multipliers(const Hierarchy& hierarchy, std::size_t k, const VectorXd& x) {
  RowSet rows(hierarchy.unknowns());
  for (std::size_t j = 0; j < k; ++j) {
    const LevelConditions level = optimality_conditions(hierarchy, j, x, 1e-8);
    rows.add(level.fixed);
    rows.add(level.touching);
  }
  if (rows.rows.rows() == 0) return true;
  Eigen::ColPivHouseholderQR<MatrixXd> factorization(rows.rows);
  factorization.setThreshold(1e-8);
  return factorization.rank() == rows.rows.rows();
}

TEST(Blockers, NamesTheLimitThatAWishRunsInto) {
  const Solved solved(2, pushed_mass(8.0));
  for (const LevelBlockers& level : solved.blockers) EXPECT_TRUE(level.is_known);
  EXPECT_EQ(solved.blockers[1].count, 0u);
  ASSERT_EQ(solved.blockers[2].count, 1u) << "the equation of motion before it is a fact";
  const Blocker& limit = solved.blockers[2].dearest[0];
  EXPECT_EQ(limit.at.level, 1u);
  EXPECT_EQ(limit.at.row, 0);
  EXPECT_NEAR(limit.multiplier, 1.5, 1e-12);
  EXPECT_NEAR(limit.cost, 3.0, 1e-12);
}

TEST(Blockers, AreNoneWhereTheWishIsMetAndNotKnownWhereTheCascadeSolved) {
  const LexicographicOptions by_cascade{.max_sweeps = 0};
  for (const bool is_known : {true, false}) {
    const Solved solved(2, pushed_mass(is_known ? 4.0 : 8.0),
                        is_known ? LexicographicOptions{} : by_cascade);
    for (const LevelBlockers& level : solved.blockers) {
      EXPECT_EQ(level.is_known, is_known);
      EXPECT_EQ(level.count, 0u);
    }
  }
}

TEST(Blockers, OfDuplicatedRowsHaveNoCostByThemselves) {
  const Solved solved(1, {between(MatrixXd::Ones(2, 1), Vector2d(-1.0, -1.0), Vector2d(1.0, 1.0)),
                          between(MatrixXd::Ones(1, 1), number(0.0), number(1.0)),
                          equalities(MatrixXd::Ones(1, 1), number(3.0))});
  ASSERT_GT(solved.blockers[2].count, 0u);
  for (const Blocker& blocker : solved.blockers[2].rows()) {
    EXPECT_EQ(blocker.cost, 0.0);
    EXPECT_GT(blocker.multiplier, 0.0);
  }
}

TEST(Blockers, OfThoseThatCostTheSameLimitsComeFirst) {
  const Solved solved(2, with_a_choice(2, {equalities(RowVector2d(-0.1, 0.1), number(0.0)),
                                           at_most(RowVector2d(1.0, 0.0), number(1.0)),
                                           equalities(RowVector2d(0.0, 1.0), number(3.0))}));
  ASSERT_EQ(solved.blockers[3].count, 2u);
  const auto [limit, equality] =
      std::tie(solved.blockers[3].dearest[0], solved.blockers[3].dearest[1]);
  EXPECT_NEAR(limit.cost, equality.cost, 1e-9);
  EXPECT_LT(limit.multiplier, equality.multiplier) << "which says nothing of what a row costs";
  EXPECT_EQ(limit.at.level, 2u);
}

TEST(Blockers, HaveTheMultipliersThatExplainFinds) {
  int compared = 0, unknown = 0;
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Solved solved(6, random_case(seed));
    const VectorXd& x = solved.solver.solution().x;
    const std::vector<LevelExplanation> exact = explain(solved.hierarchy, x);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      unknown += solved.blockers[k].is_known ? 0 : 1;
      if (!solved.blockers[k].is_known) continue;
      if (!has_unique_multipliers(solved.hierarchy, k, x)) continue;
      ASSERT_EQ(solved.blockers[k].count, std::min<std::size_t>(exact[k].blocked_by.size(), 8));
      for (const Blocker& expected : exact[k].blocked_by) {
        const Blocker* found = find(solved.blockers[k], expected.at);
        ASSERT_NE(found, nullptr);
        ASSERT_NEAR(found->multiplier, expected.multiplier, 1e-7 * (1.0 + expected.multiplier));
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 300);
  EXPECT_LT(unknown, 100) << "of 2500 levels";
}

/// Residual of the last level, its rows that count as equalities, below all rows that hold x but
/// one, as equalities.
double last_residual_without(const Hierarchy& hierarchy, const Solution& solution, RowIndex row) {
  HierarchyData levels(2);
  const auto append = [&](std::size_t to, std::size_t k, Index i, double bound) {
    levels[to] = joined(levels[to], equalities(hierarchy.level(k).A().row(i), number(bound)));
  };
  const std::size_t last = hierarchy.num_levels() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const Level& level = hierarchy.level(k);
    for (Index i = 0; i < level.num_rows(); ++i) {
      const RowState state = solution.levels[k].rows[static_cast<std::size_t>(i)];
      if (state == RowState::inactive || (k == row.level && i == row.row)) continue;
      if (k < last) {
        append(0, k, i, level.A().row(i).dot(solution.x));
      } else if (state != RowState::at_lower && state != RowState::at_upper) {
        append(1, k, i, state == RowState::below_lower ? level.lower()[i] : level.upper()[i]);
      }
    }
  }
  return solve(hierarchy.unknowns(), levels).levels[1].residual;
}

TEST(Blockers, CostWhatIsGainedWithoutTheRowWhenAllElseStaysWhatItIs) {
  int compared = 0;
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Solved solved(6, random_case(seed));
    const Solution& solution = solved.solver.solution();
    for (const Blocker& blocker : solved.blockers.back().rows()) {
      const double left = last_residual_without(solved.hierarchy, solution, blocker.at);
      const double residual = solution.levels.back().residual;
      ASSERT_NEAR(blocker.cost, residual - left, 1e-6 * (1.0 + residual));
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

TEST(Blockers, OftenCostWhatExplainFinds) {
  int all = 0, same = 0, more = 0, less = 0;
  for (int seed = 0; seed < 500; ++seed) {
    const Solved solved(6, random_case(seed));
    const std::vector<LevelExplanation> exact =
        explain(solved.hierarchy, solved.solver.solution().x);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      for (const Blocker& expected : exact[k].blocked_by) {
        const Blocker* found = find(solved.blockers[k], expected.at);
        if (found == nullptr) continue;
        const double by = found->cost - expected.cost;
        const double small = 1e-6 * (1.0 + exact[k].residual);
        ++all;
        same += std::abs(by) <= small ? 1 : 0;
        more += by > small ? 1 : 0;
        less += by < -small ? 1 : 0;
      }
    }
  }
  EXPECT_GT(same, 2 * all / 5) << same << " alike, " << more << " of " << all
                               << " dearer than exact, " << less << " cheaper";
  EXPECT_GT(more, 0) << "where the row meets an inactive one";
  EXPECT_GT(less, 0) << "where other rows let go";
}

TEST(Blockers, AreNotKnownOfALeadingLevelWithAResidual) {
  const HierarchyData levels{equalities(MatrixXd::Ones(1, 1), number(1.0)),
                             equalities(MatrixXd::Ones(1, 1), number(2.0)),
                             at_most(MatrixXd::Ones(1, 1), number(5.0))};
  const Solved solved(1, levels);
  EXPECT_TRUE(solved.blockers[0].is_known);
  EXPECT_FALSE(solved.blockers[1].is_known);
  EXPECT_TRUE(solved.blockers[2].is_known);
}

double ticking_clock() {
  static double time = 0.0;
  return time += 0.25;
}

TEST(Solution, HasTheTimeOfTheClockThatTheSolverWasGiven) {
  EXPECT_EQ(Solved(2, pushed_mass(8.0)).solver.solution().time, 0.0);
  const Solved timed(2, pushed_mass(8.0), {.clock = ticking_clock});
  EXPECT_GE(timed.solver.solution().time, 0.25);
}

TEST(Solution, OfTheCascadeHasTheTimeOfEachLevelToo) {
  const Hierarchy hierarchy = make_hierarchy(2, pushed_mass(8.0));
  CascadeSolver silent(hierarchy);
  EXPECT_EQ(silent.solve(hierarchy).time, 0.0);
  EXPECT_EQ(silent.solution().levels[0].time, 0.0);
  CascadeSolver timed(hierarchy, {.rank = {}, .clock = ticking_clock});
  const Solution& solution = timed.solve(hierarchy);
  for (const LevelResult& level : solution.levels) EXPECT_EQ(level.time, 0.25);
  EXPECT_EQ(solution.time, 0.25 * (1.0 + 2.0 * static_cast<double>(solution.levels.size())));
  EXPECT_EQ(solution.x, silent.solution().x);
}

}  // namespace
}  // namespace surefoot::solver
