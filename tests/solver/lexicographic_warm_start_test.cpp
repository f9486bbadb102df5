#include "tests/solver/guess.hpp"
#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 9;
constexpr int kSeeds = 300;

HierarchyData random_case(RandomMatrices& random) {
  HierarchyData levels = random_levels(random, {.unknowns = kUnknowns,
                                                .levels = 6,
                                                .max_rows = 6,
                                                .inequality_share = 0.8,
                                                .duplicate_share = 0.1,
                                                .tight_share = 0.2});
  levels.push_back(close_to(random.vector(kUnknowns)));
  return levels;
}

/// Solves `levels` after `before` has left its active rows as a guess.
template <typename Choice>
void expect_same_answer_after(Choice&& side_of) {
  for (SeededRandom& random : Seeds(kSeeds)) {
    const HierarchyData levels = random_case(random);
    const Hierarchy hierarchy = named(kUnknowns, levels);
    const Solution cold = CascadeSolver(hierarchy).solve(hierarchy);
    LexicographicSolver solver(hierarchy);
    (void)solver.solve(
        named(kUnknowns, guess(levels, [&](std::size_t k, Index i) {
                return side_of(random,
                               static_cast<int>(cold.levels[k].rows[static_cast<std::size_t>(i)]));
              })));
    const Solution& warm = solver.solve(hierarchy);
    ASSERT_EQ(warm.status, SolveStatus::optimal);
    ASSERT_LE((warm.x - cold.x).norm(), 1e-9 * (1.0 + cold.x.norm()));
    ASSERT_LE(worst_stationarity(certify(hierarchy, warm.x)), 1e-9);
  }
}

/// Levels of small integers that leave x open here and there.
HierarchyData open_levels(RandomMatrices& random, Index unknowns) {
  HierarchyData levels;
  for (int k = random.integer(1, 3); k > 0; --k) {
    const Index rows = random.integer(1, 4);
    LevelData level{MatrixXd(rows, unknowns), VectorXd(rows), VectorXd(rows)};
    for (Index i = 0; i < rows; ++i) {
      for (Index j = 0; j < unknowns; ++j) level.A(i, j) = random.integer(-3, 3);
      level.lower[i] = level.upper[i] = random.integer(-5, 5);
      const int kind = random.integer(0, 9);
      if (kind >= 4) level.lower[i] = -kInfinity;
      if (kind >= 7) level.lower[i] = level.upper[i] - random.integer(1, 3);
    }
    levels.push_back(level);
  }
  return levels;
}

// Rows that only the length of x pulls at, next to a last level that takes all columns.
TEST(LexicographicWarmStart, AnyGuessLeadsToTheShortest) {
  for (SeededRandom& random : Seeds(20000)) {
    const Index unknowns = random.integer(2, 8);
    HierarchyData levels = open_levels(random, unknowns), before = levels;
    for (LevelData& level : before) {
      const double shift = random.integer(-6, 6);
      level.lower.array() += shift;
      level.upper.array() += shift;
    }
    const Hierarchy hierarchy = named(unknowns, levels);
    const VectorXd cold = LexicographicSolver(hierarchy).solve(hierarchy).x;
    LexicographicSolver solver(hierarchy);
    (void)solver.solve(named(unknowns, before));
    const VectorXd warm = solver.solve(hierarchy).x;
    levels.push_back(close_to(VectorXd::Zero(unknowns)));
    const Hierarchy closed = named(unknowns, levels);
    const VectorXd shortest = LexicographicSolver(closed).solve(closed).x;
    ASSERT_LE((cold - shortest).norm(), 1e-6 * (1.0 + shortest.norm()));
    ASSERT_LE((warm - shortest).norm(), 1e-6 * (1.0 + shortest.norm()));
  }
}

TEST(LexicographicWarmStart, NoGuessChangesTheAnswer) {
  expect_same_answer_after([](RandomMatrices& random, int) { return random.integer(-1, 1); });
  expect_same_answer_after([](RandomMatrices&, int state) { return -test::sign(state); });
  expect_same_answer_after([](RandomMatrices&, int) { return 1; });
  expect_same_answer_after([](RandomMatrices& random, int state) {
    return random.chance(0.1) ? random.integer(-1, 1) : test::sign(state);
  });
}

TEST(LexicographicWarmStart, TheSameProblemAgainTakesOneSweepAndGivesTheSameX) {
  int num_swept_once = 0;
  for (SeededRandom& random : Seeds(kSeeds)) {
    const Hierarchy hierarchy = make_hierarchy(30, walk_levels(random, 1.0));
    LexicographicSolver solver(hierarchy);
    const VectorXd first = solver.solve(hierarchy).x;
    const VectorXd second = solver.solve(hierarchy).x;
    num_swept_once += solver.num_sweeps() == 1 ? 1 : 0;
    ASSERT_LE((first - second).norm(), 1e-9 * (1.0 + first.norm()));
  }
  EXPECT_GE(num_swept_once, kSeeds * 99 / 100);
}

TEST(LexicographicWarmStart, RowsAreFoundAgainInOtherPlacesAndLevelsInAnotherOrder) {
  int num_swept_once = 0;
  for (SeededRandom& random : Seeds(kSeeds)) {
    const HierarchyData levels = random_case(random);
    const Hierarchy hierarchy = named(kUnknowns, levels);
    // A level without influence comes first, and every level has its rows backwards.
    Hierarchy moved(kUnknowns);
    moved.add_level("new", 12);
    for (std::size_t k = 0; k < levels.size(); ++k) {
      moved.add_level("level " + std::to_string(k), levels[k].lower.size());
      for (Index i = levels[k].lower.size() - 1; i >= 0; --i) {
        Rows row = moved.level(k + 1).add(1, static_cast<int>(i));
        row.A = levels[k].A.row(i);
        row.lower[0] = levels[k].lower[i];
        row.upper[0] = levels[k].upper[i];
      }
    }
    Hierarchy capacity(kUnknowns);
    for (std::size_t k = 0; k < levels.size() + 1; ++k) capacity.add_level("", 12);
    LexicographicSolver solver(capacity);
    const VectorXd x = solver.solve(hierarchy).x;
    const Solution& after = solver.solve(moved);
    num_swept_once += solver.num_sweeps() == 1 ? 1 : 0;
    ASSERT_LE((after.x - x).norm(), 1e-9 * (1.0 + x.norm()));
  }
  EXPECT_GE(num_swept_once, kSeeds * 9 / 10);
}

TEST(LexicographicWarmStart, ContactsThatSwitchInAWalkChangeNothing) {
  RandomMatrices random(5);
  Hierarchy capacity(30);
  for (int k = 0; k < 11; ++k) capacity.add_level("level", 20);
  LexicographicSolver solver(capacity);
  int num_unique = 0;
  for (int tick = 0; tick < 300; ++tick) {
    const Hierarchy hierarchy =
        make_hierarchy(30, table_one_levels(random, 2 + tick % 3, random.uniform(0.0, 1.0)));
    const VectorXd expected = CascadeSolver(hierarchy).solve(hierarchy).x;
    const Solution& solution = solver.solve(hierarchy);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(worst_stationarity(certify(hierarchy, solution.x)), 1e-9) << "tick " << tick;
    const bool is_unique = solution.levels[10].degrees_of_freedom_left == 0;
    ASSERT_TRUE(!is_unique || (solution.x - expected).norm() <= 1e-9 * (1.0 + expected.norm()))
        << "tick " << tick;
    num_unique += is_unique ? 1 : 0;
  }
  EXPECT_GT(num_unique, 90);
}

TEST(LexicographicWarmStart, TheSameSequenceGivesTheSameBits) {
  RandomMatrices random(6);
  std::vector<Hierarchy> ticks;
  for (int tick = 0; tick < 60; ++tick) {
    ticks.push_back(make_hierarchy(30, table_one_levels(random, 4, random.uniform(0.0, 1.0))));
  }
  LexicographicSolver first(ticks[0]), second(ticks[0]);
  for (const Hierarchy& tick : ticks) (void)first.solve(tick);
  first.forget();
  for (const Hierarchy& tick : ticks) {
    ASSERT_EQ(first.solve(tick).x, second.solve(tick).x);
  }
}

HierarchyData unique_case(int seed) {
  RandomMatrices random(static_cast<std::uint64_t>(seed));
  return random_case(random);
}

TEST(WarmStart, ALevelThatComesBackHasItsGuess) {
  double cold_flops = 0.0, warm_flops = 0.0;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy all = named(kUnknowns, unique_case(seed));
    Hierarchy without = all;
    without.level(2).clear();
    LexicographicSolver solver(all);
    (void)solver.solve(all);
    cold_flops += solver.flops();
    LexicographicSolver memory = LexicographicSolver(all);
    (void)memory.solve(all);
    for (int tick = 0; tick < 3; ++tick) (void)memory.solve(without);
    (void)memory.solve(all);
    warm_flops += memory.flops();
    ASSERT_LE((memory.solution().x - solver.solution().x).norm(), 1e-8);
  }
  EXPECT_LT(warm_flops, cold_flops);
}

TEST(WarmStart, ALevelThatMovedHasItsGuessWhereAnEmptyPlaceHasItsName) {
  // "level 1" moves from place 1 to 2 and back: what is left at its old place says nothing of it.
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const HierarchyData levels = unique_case(seed);
    const Hierarchy all = named(kUnknowns, levels);
    Hierarchy shifted(kUnknowns);  // with a level in front, and one less at the end
    Hierarchy capacity(kUnknowns);
    for (std::size_t k = 0; k <= levels.size(); ++k) capacity.add_level("", 12);
    shifted.add_level("front", 0);
    for (std::size_t k = 0; k < all.num_levels(); ++k) {
      shifted.add_level(all.level(k).name(), all.level(k).num_rows());
      (void)shifted.level(k + 1).add(all.level(k));
    }
    LexicographicSolver solver(capacity);
    (void)solver.solve(shifted);
    (void)solver.solve(all);
    (void)solver.solve(all);
    const int settled = solver.num_sweeps();
    (void)solver.solve(shifted);
    ASSERT_LE(solver.num_sweeps(), settled);
  }
}

TEST(WarmStart, AfterInvalidInputNothingIsSaidOfSweeps) {
  Hierarchy hierarchy = named(kUnknowns, unique_case(1));
  LexicographicSolver solver(hierarchy);
  (void)solver.solve(hierarchy);
  EXPECT_GT(solver.num_sweeps(), 0);
  hierarchy.level(0).rows().A(0, 0) = std::numeric_limits<double>::quiet_NaN();
  (void)solver.solve(hierarchy);
  EXPECT_EQ(solver.num_sweeps(), 0);
}

}  // namespace
}  // namespace surefoot::solver
