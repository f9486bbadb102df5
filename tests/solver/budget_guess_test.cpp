// A budget may end a solve anywhere, with any guess and in any basis.

#include "tests/solver/guess.hpp"
#include "tests/solver/solve.hpp"
#include "tests/support/substitutions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;
constexpr std::size_t kPhysics = 2;  // levels of equalities that come first
constexpr int kSeeds = 12;
constexpr double kTolerance = 1e-8;

/// Advances by `step` at each call, so that it can end a solve at any of them.
struct Clock {
  static inline double now = 0.0, step = 0.0;
  static double read() { return now += step; }
  static void stand_still() { step = 0.0; }
  /// A second has gone by at the question `count` after the first.
  static void end_at(int count) { step = 1.0 / (count - 0.5); }
};

enum class Basis { identity, of_leading_equalities, orthonormal, skew };
enum class Guess { none, stale, inverted, random, of_a_solve_cut_short };
constexpr std::array kBases{Basis::identity, Basis::of_leading_equalities, Basis::orthonormal,
                            Basis::skew};
constexpr std::array kGuesses{Guess::none, Guess::stale, Guess::inverted, Guess::random,
                              Guess::of_a_solve_cut_short};

/// Every second one leaves x open: there the shortest x is asked for.
HierarchyData random_case(std::uint64_t seed, Basis basis) {
  RandomMatrices random(seed);
  HierarchyData levels = table_one_levels(random, 4, seed % 3 == 0 ? 0.5 : 1.0);
  if (seed % 2 == 0) levels.resize(6);
  if (basis == Basis::identity) levels.erase(levels.begin(), levels.begin() + kPhysics);
  return levels;
}

/// A problem, a solver for it that can be ended anywhere, and what it must not depend on.
class Case {
 public:
  Case(std::uint64_t seed, Basis basis, Guess guess)
      : seed_(seed),
        basis_(basis),
        guess_(guess),
        levels_(random_case(seed, basis)),
        hierarchy_(named(kUnknowns, levels_)),
        optimum_(LexicographicSolver(hierarchy_).solve(hierarchy_)),
        solver_(hierarchy_, options()) {}

  /// Solves once more, until the clock ends it.
  const Solution& solve_until(int count) {
    guess();
    Clock::end_at(count);
    return solve(levels_);
  }

  const Solution& solve_to_the_end() {
    Clock::stand_still();
    return solve(levels_);
  }

  void expect_optimal(const Solution& solution) const {
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE((solution.x - optimum_.x).norm(), kTolerance * (1.0 + optimum_.x.norm()));
  }

  /// Every finished level is as good as at the optimum, and none is reported better than it is.
  void expect_safe(const Solution& solution) const {
    ASSERT_EQ(solution.status, SolveStatus::iteration_cap);
    ASSERT_GE(solution.failed_level, basis_ == Basis::identity ? 0 : static_cast<int>(kPhysics));
    for (std::size_t k = 0; k < hierarchy_.num_levels(); ++k) {
      const Level& level = hierarchy_.level(k);
      const VectorXd value = level.A() * solution.x;
      const double residual =
          (value - level.upper()).cwiseMax(level.lower() - value).cwiseMax(0.0).norm();
      ASSERT_NEAR(solution.levels[k].residual, residual, kTolerance * (1.0 + residual));
      if (static_cast<int>(k) >= solution.failed_level) continue;
      const double expected = optimum_.levels[k].residual;
      ASSERT_NEAR(residual, expected, kTolerance * (1.0 + expected)) << "level " << k;
    }
  }

 private:
  static LexicographicOptions options() {
    LexicographicOptions options;
    options.budget.seconds = 1.0;
    options.clock = Clock::read;
    return options;
  }

  const Solution& solve(const HierarchyData& levels) {
    hierarchy_ = named(kUnknowns, levels);
    if (basis_ == Basis::orthonormal || basis_ == Basis::skew) {
      RandomMatrices random(3);
      const bool is_skew = basis_ == Basis::skew;
      return solver_.solve(hierarchy_, is_skew ? skew_substitution_of(levels, kPhysics, random)
                                               : substitution_of(levels, kPhysics));
    }
    return solver_.solve(hierarchy_);
  }

  void guess() {
    Clock::stand_still();
    RandomMatrices random(seed_);
    switch (guess_) {
      case Guess::none:
        return solver_.forget();
      case Guess::stale:
        return (void)solve(random_case(seed_ + 2, basis_));  // the next of its shape
      case Guess::of_a_solve_cut_short:
        solver_.forget();
        Clock::end_at(9);
        return (void)solve(random_case(seed_ + 2, basis_));
      case Guess::inverted:
      case Guess::random:
        return guess_sides([&](std::size_t k, Index i) {
          const int state = static_cast<int>(optimum_.levels[k].rows[static_cast<std::size_t>(i)]);
          return guess_ == Guess::inverted ? -test::sign(state) : random.integer(-1, 1);
        });
    }
  }

  template <typename Choice>
  void guess_sides(Choice&& side_of) {
    (void)solver_.solve(named(kUnknowns, test::guess(levels_, side_of)));
  }

  std::uint64_t seed_;
  Basis basis_;
  Guess guess_;
  HierarchyData levels_;
  Hierarchy hierarchy_;
  Solution optimum_;
  LexicographicSolver solver_;
};

/// Ends the solve at each question for the time; returns how many times before the optimum.
int end_everywhere(Case& problem) {
  int finished = 0, most_finished = 0;
  for (int count = 1; count < 1000; ++count) {
    SCOPED_TRACE("ended at question " + std::to_string(count));
    const Solution& solution = problem.solve_until(count);
    if (solution.status == SolveStatus::optimal) {
      problem.expect_optimal(solution);
      return count - 1;
    }
    problem.expect_safe(solution);
    finished = solution.failed_level;
    EXPECT_GE(finished, most_finished) << "more is never less";
    most_finished = std::max(most_finished, finished);
    problem.expect_optimal(problem.solve_to_the_end());
    if (testing::Test::HasFailure()) return 0;
  }
  ADD_FAILURE() << "it never comes to the optimum";
  return 0;
}

TEST(BudgetAndGuess, WhereverItEndsTheFinishedLevelsAreOptimalAndTheNextSolveIs) {
  for (const Basis basis : kBases) {
    for (const Guess guess : kGuesses) {
      SCOPED_TRACE("basis " + std::to_string(static_cast<int>(basis)) + ", guess " +
                   std::to_string(static_cast<int>(guess)));
      int num_early = 0;
      for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Case problem(seed, basis, guess);
        num_early += end_everywhere(problem);
        ASSERT_FALSE(HasFailure());
      }
      EXPECT_GT(num_early, 5 * kSeeds);
    }
  }
}

}  // namespace
}  // namespace surefoot::solver
