#include "surefoot/solver/tolerances.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/substitutions.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace surefoot::solver {
namespace {

/// While it lives, an invalid operation, a division by zero or an overflow ends the program.
class FloatTraps {
 public:
  FloatTraps() {
    std::feclearexcept(kTrapped);
    feenableexcept(kTrapped);
  }
  ~FloatTraps() { fedisableexcept(kTrapped); }
  FloatTraps(const FloatTraps&) = delete;
  FloatTraps& operator=(const FloatTraps&) = delete;

 private:
  static constexpr int kTrapped = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
};

/// Solved twice, so that the second time there is a guess.
template <typename Solver>
void expect_solved_under_traps(Index unknowns, const HierarchyData& levels) {
  const Hierarchy hierarchy = make_hierarchy(unknowns, levels);
  Solver solver(hierarchy);
  for (int time = 0; time < 2; ++time) {
    const FloatTraps traps;
    ASSERT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal);
  }
}

template <typename Solver>
class FloatTrapped : public testing::Test {};
TYPED_TEST_SUITE(FloatTrapped, Solvers);

TYPED_TEST(FloatTrapped, NumbersThatAreNoneAreRefused) {
  const double nan = std::nan("");
  for (int which = 1; which < 8; ++which) {
    SCOPED_TRACE(which);
    LevelData level{MatrixXd::Ones(3, 2), -VectorXd::Ones(3), VectorXd::Ones(3)};
    if ((which & 1) != 0) level.A(1, 0) = nan;
    if ((which & 2) != 0) level.lower[1] = nan;
    if ((which & 4) != 0) level.upper[1] = nan;
    const Hierarchy hierarchy = make_hierarchy(2, {level});
    TypeParam solver(hierarchy);
    const FloatTraps traps;
    EXPECT_EQ(solver.solve(hierarchy).status, SolveStatus::invalid_input);
  }
}

/// Up to 5 rows of small integers in each of 6 levels, sides of which are infinite at times.
Hierarchy any_rows(RandomMatrices& random) {
  Hierarchy hierarchy(8);
  for (int k = 0; k < 6; ++k) {
    hierarchy.add_level("level " + std::to_string(k), 5);
    for (int i = random.integer(0, 5); i > 0; --i) {
      Rows row = hierarchy.level(static_cast<std::size_t>(k)).add(1, i);
      for (int j = 0; j < 8; ++j) row.A(0, j) = random.chance(2.0 / 3) ? random.integer(-3, 3) : 0;
      const double bound = random.integer(-5, 5);
      const int kind = random.integer(0, 3);
      row.lower[0] = kind == 1 ? -kInfinity : bound;
      row.upper[0] = kind == 0 ? bound : kind == 2 ? kInfinity : bound + random.integer(0, 3);
    }
  }
  return hierarchy;
}

// A solve may leave infinities next to the rows of the next, smaller one.
TYPED_TEST(FloatTrapped, OneSolverMayBeAskedOneHierarchyAfterAnother) {
  RandomMatrices random(7);
  TypeParam solver([] {
    Hierarchy room(8);
    for (int k = 0; k < 6; ++k) room.add_level("level " + std::to_string(k), 5);
    return room;
  }());
  for (int i = 0; i < 40000; ++i) {
    const Hierarchy hierarchy = any_rows(random);
    const FloatTraps traps;
    ASSERT_EQ(solver.solve(hierarchy).status, SolveStatus::optimal) << i;
  }
}

constexpr double kLimit = tolerance::kLargest;

/// Where in a level of three rows a number may be too large.
enum class Where { coefficient, coefficient_at_the_end, lower, upper, equality };

LevelData with_number(double number, Where where) {
  LevelData level{MatrixXd::Ones(3, 5), -VectorXd::Ones(3), VectorXd::Ones(3)};
  switch (where) {
    case Where::coefficient:
      level.A(1, 0) = number;
      break;
    case Where::coefficient_at_the_end:
      level.A(2, 4) = number;
      break;
    case Where::lower:
      level.lower[1] = -std::abs(number);
      break;
    case Where::upper:
      level.upper[1] = std::abs(number);
      break;
    case Where::equality:
      level.lower[1] = level.upper[1] = number;
      break;
  }
  return level;
}

TYPED_TEST(FloatTrapped, NumbersWithoutASquareAreRefused) {
  const double largest = std::numeric_limits<double>::max();
  for (const Where where : {Where::coefficient, Where::coefficient_at_the_end, Where::lower,
                            Where::upper, Where::equality}) {
    for (const double number : {1.001 * kLimit, 1e155, 1e200, 1e300, largest}) {
      for (const double sign : {-1.0, 1.0}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(where) << ", " << number);
        const Hierarchy good =
            make_hierarchy(5, {close_to(VectorXd::Ones(5)), with_number(1.0, where)});
        const Hierarchy bad =
            make_hierarchy(5, {close_to(VectorXd::Ones(5)), with_number(sign * number, where)});
        TypeParam solver(good);
        const FloatTraps traps;
        EXPECT_EQ(solver.solve(good).status, SolveStatus::optimal);
        const Solution& solution = solver.solve(bad);
        EXPECT_EQ(solution.status, SolveStatus::invalid_input);
        EXPECT_EQ(solution.failed_level, 1);
        EXPECT_EQ(solution.x, VectorXd::Zero(5));
        EXPECT_EQ(std::fetestexcept(FE_OVERFLOW | FE_INVALID), 0);
        EXPECT_EQ(solver.solve(good).status, SolveStatus::optimal);
      }
    }
  }
}

TYPED_TEST(FloatTrapped, NumbersUpToTheLimitAreSolved) {
  const MatrixXd one = MatrixXd::Ones(1, 1);
  expect_solved_under_traps<TypeParam>(1, {equalities(kLimit * one, number(-kLimit))});
  expect_solved_under_traps<TypeParam>(1, {equalities(one, number(kLimit))});
  expect_solved_under_traps<TypeParam>(
      1, {between(one, number(-kLimit), number(kLimit)), at_most(kLimit * one, number(-kLimit))});
}

TYPED_TEST(FloatTrapped, LevelsOfVeryDifferentSizesAreSolved) {
  for (const auto& [smallest, largest] : {std::pair(-98, 98), std::pair(0, 145)}) {
    for (int seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", up to 1e" + std::to_string(largest));
      RandomMatrices random(static_cast<std::uint64_t>(seed));
      HierarchyData levels =
          random_levels(random, {.unknowns = 6, .levels = 4, .inequality_share = 0.6});
      for (LevelData& level : levels) {
        const double size = std::pow(10.0, random.integer(smallest, largest));
        level.A *= size;
        level.lower *= size;
        level.upper *= size;
      }
      expect_solved_under_traps<TypeParam>(6, levels);
    }
  }
}

TYPED_TEST(FloatTrapped, ARowTooShortToHaveASquareAsksForNothing) {
  LevelData level{MatrixXd::Identity(2, 2), VectorXd::Ones(2), VectorXd::Constant(2, 2.0)};
  level.A(1, 1) = 1e-160;
  const Hierarchy hierarchy = make_hierarchy(2, {level, close_to(VectorXd::Constant(2, 5.0))});
  TypeParam solver(hierarchy);
  const FloatTraps traps;
  const Solution& solution = solver.solve(hierarchy);
  EXPECT_EQ(solution.status, SolveStatus::optimal);
  EXPECT_NEAR(solution.x[0], 2.0, 1e-12);
}

TYPED_TEST(FloatTrapped, RandomAndDegenerateHierarchiesAndThoseOfAWalkAreSolved) {
  for (SeededRandom& random : Seeds(300)) {
    const RandomOptions plain{.unknowns = 8, .levels = 5, .inequality_share = 0.6};
    expect_solved_under_traps<TypeParam>(8, random_levels(random, plain));
    const RandomOptions degenerate{.unknowns = 8,
                                   .levels = 6,
                                   .max_rows = 12,
                                   .inequality_share = 0.7,
                                   .duplicate_share = 0.2,
                                   .dependent_share = 0.2,
                                   .zero_share = 0.1,
                                   .tight_share = 0.5,
                                   .integer_share = 0.5};
    expect_solved_under_traps<TypeParam>(8, random_levels(random, degenerate));
    if (random.seed() >= 60) continue;
    expect_solved_under_traps<TypeParam>(30, walk_levels(random, 0.5 * (random.seed() % 3)));
  }
}

TYPED_TEST(FloatTrapped, WeakDirectionsAndLargeNumbersAreSolved) {
  for (int exponent = -150; exponent <= 90; ++exponent) {
    SCOPED_TRACE("1e" + std::to_string(exponent));
    const double size = std::pow(10.0, exponent);
    const MatrixXd A = (MatrixXd(2, 2) << 1.0, 0.0, 1.0, size).finished();
    expect_solved_under_traps<TypeParam>(
        2, {equalities(A, VectorXd::Ones(2)), at_most(A.bottomRows(1), -VectorXd::Ones(1))});
  }
}

TYPED_TEST(FloatTrapped, AProblemAfterALargerOneIsSolved) {
  for (SeededRandom& random : Seeds(60)) {
    const HierarchyData large = table_one_levels(random, 4, 1.0);
    const Hierarchy capacity = make_hierarchy(30, large);
    TypeParam solver(capacity);
    for (int time = 0; time < 6; ++time) {
      const Hierarchy hierarchy = make_hierarchy(30, table_one_levels(random, 4 - time % 3, 1.0));
      Hierarchy fewer(30);
      for (std::size_t k = 0; k < hierarchy.num_levels() - static_cast<std::size_t>(time); ++k) {
        fewer.add_level(hierarchy.level(k).name(), hierarchy.level(k).num_rows());
        (void)fewer.level(k).add(hierarchy.level(k));
      }
      // Warm, most rows of the large problem are never looked at, which leaves infinities.
      for (int again = 0; again < 2; ++again) (void)solver.solve(capacity);
      const FloatTraps traps;
      ASSERT_NE(solver.solve(fewer).status, SolveStatus::iteration_cap);
    }
  }
}

/// Many inactive rows that a warm solver never evaluates again.
HierarchyData idle_rows(RandomMatrices& random, Index unknowns) {
  return {equalities(random.matrix(1, unknowns), random.vector(1)),
          at_most(random.matrix(60, unknowns), VectorXd::Constant(60, 1e6))};
}

/// Limits that x = 0 violates by half, so that the search descends, and another x doesn't: few hold
/// in the end, and the length of x is left to be minimised between them.
HierarchyData far_limits(RandomMatrices& random, Index unknowns, Index fixed) {
  const Index rows = random.integer(24, 50);
  const VectorXd far = 10.0 * random.vector(unknowns);
  const LevelData first = equalities(random.matrix(fixed, unknowns), random.vector(fixed));
  const MatrixXd D = random.matrix(rows, unknowns);
  return {equalities(first.A, first.A * far), at_most(D, D * far + VectorXd::Constant(rows, 0.5))};
}

TEST(FloatTraps, DoNotMeetWhatALargerProblemHasLeftBesideTheRowsOfASmallerOne) {
  constexpr Index kUnknowns = 8;
  for (SeededRandom& random : Seeds(200)) {
    // Descends through nearly all rows, which leaves their numbers; then most are never looked at,
    // which leaves infinities.
    const Hierarchy crowded = make_hierarchy(kUnknowns, far_limits(random, kUnknowns, 1));
    const Hierarchy idle = make_hierarchy(kUnknowns, idle_rows(random, kUnknowns));
    const HierarchyData levels = far_limits(random, kUnknowns, random.integer(3, 6));
    const Hierarchy small = make_hierarchy(kUnknowns, levels);
    const Substitution substitution = substitution_of(levels, 1);
    Hierarchy capacity(kUnknowns);
    for (int k = 0; k < 2; ++k) capacity.add_level("level", 60);
    for (const SweepKernels* kernels : all_kernels()) {
      SCOPED_TRACE(kernels->name);
      LexicographicSolver solver(capacity, {.kernels = kernels});
      for (const bool has_substitution : {false, true}) {
        ASSERT_EQ(solver.solve(crowded).status, SolveStatus::optimal);
        solver.forget();
        ASSERT_EQ(solver.solve(idle).status, SolveStatus::optimal);
        solver.forget();
        const FloatTraps traps;
        const Solution& solution =
            has_substitution ? solver.solve(small, substitution) : solver.solve(small);
        ASSERT_EQ(solution.status, SolveStatus::optimal);
      }
    }
  }
}

TEST(FloatTraps, DoNotMeetASubstitutionWithoutSquares) {
  RandomMatrices random(1);
  const HierarchyData levels = far_limits(random, 8, 4);
  const Hierarchy hierarchy = make_hierarchy(8, levels);
  for (const double odd : {1e155, -1e300, std::numeric_limits<double>::max(), std::nan("")}) {
    SCOPED_TRACE(odd);
    for (const bool is_offset : {false, true}) {
      Substitution substitution = substitution_of(levels, 1);
      (is_offset ? substitution.offset[3] : substitution.basis(3, 1)) = odd;
      LexicographicSolver solver(hierarchy), without(hierarchy);
      const FloatTraps traps;
      const Solution& solution = solver.solve(hierarchy, substitution);
      ASSERT_EQ(solution.status, SolveStatus::optimal);
      EXPECT_EQ(solution.x, without.solve(hierarchy).x);
    }
  }
}

TEST(FloatTraps, EndTheProgramWhereTheyShould) {
  volatile double zero = 0.0;
  EXPECT_DEATH(
      {
        const FloatTraps traps;
        zero = zero / zero;
      },
      "");
}

}  // namespace
}  // namespace surefoot::solver
