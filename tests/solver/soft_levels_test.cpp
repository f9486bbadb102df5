#include "surefoot/solver/soft_levels.hpp"

#include "tests/solver/solve.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kUnknowns = 8;

Hierarchy random_hierarchy(int seed) {
  RandomMatrices random(static_cast<std::uint64_t>(seed));
  HierarchyData levels = random_levels(
      random, {.unknowns = kUnknowns, .levels = 5, .max_rows = 4, .inequality_share = 0.7});
  levels.push_back(close_to(random.vector(kUnknowns)));
  return make_hierarchy(kUnknowns, levels);
}

/// x as a function of s.
class Transition {
 public:
  Transition(const Hierarchy& hierarchy, std::span<const std::size_t> soft)
      : hierarchy_(hierarchy), soft_(soft), levels_(hierarchy), solver_(hierarchy) {}

  VectorXd x(double share) { return solver_.solve(levels_.update(hierarchy_, soft_, share)).x; }

 private:
  const Hierarchy& hierarchy_;
  std::span<const std::size_t> soft_;
  SoftLevels levels_;
  LexicographicSolver solver_;
};

/// Halves the interval, always where x changes more; where x jumps, the change stays.
double change_at_the_steepest_place(Transition& transition, double from, double to) {
  VectorXd x_from = transition.x(from), x_to = transition.x(to);
  for (int halving = 0; halving < 24; ++halving) {
    const double middle = 0.5 * (from + to);
    const VectorXd x = transition.x(middle);
    if ((x - x_from).norm() > (x - x_to).norm()) {
      to = middle;
      x_to = x;
    } else {
      from = middle;
      x_from = x;
    }
  }
  return (x_to - x_from).norm();
}

constexpr std::array<std::size_t, 1> kOne{2};
constexpr std::array<std::size_t, 2> kTwo{0, 3};

void expect_no_jump(std::span<const std::size_t> soft) {
  constexpr int kSteps = 20;
  for (int seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = random_hierarchy(seed);
    Transition transition(hierarchy, soft);
    const double size = 1.0 + transition.x(0.0).norm() + transition.x(1.0).norm();
    for (int i = 0; i < kSteps; ++i) {
      const double from = static_cast<double>(i) / kSteps;
      ASSERT_LE(change_at_the_steepest_place(transition, from, from + 1.0 / kSteps), 1e-5 * size)
          << "from " << from;
    }
  }
}

TEST(SoftLevels, XHasNoJumpWhileALevelComes) { expect_no_jump(kOne); }

TEST(SoftLevels, XHasNoJumpWhileTwoLevelsCome) { expect_no_jump(kTwo); }

TEST(SoftLevels, TheStepsOfXShrinkWithThoseOfTheShare) {
  for (int seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = random_hierarchy(seed);
    Transition transition(hierarchy, kOne);
    const auto largest_step = [&](int num_steps) {
      double largest = 0.0;
      VectorXd before = transition.x(0.0);
      for (int i = 1; i <= num_steps; ++i) {
        const VectorXd x = transition.x(static_cast<double>(i) / num_steps);
        largest = std::max(largest, (x - before).norm());
        before = x;
      }
      return largest;
    };
    ASSERT_LE(largest_step(2000), 0.2 * largest_step(100) + 1e-9);
  }
}

TEST(SoftLevels, TheEndsAreTheHierarchiesWithAndWithoutTheLevel) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy with = random_hierarchy(seed);
    Hierarchy without = with;
    without.level(2).clear();
    Transition transition(with, kOne);
    ASSERT_LE((transition.x(1.0) - CascadeSolver(with).solve(with).x).norm(), 1e-9);
    const VectorXd x = CascadeSolver(without).solve(without).x;
    ASSERT_LE((transition.x(0.0) - x).norm(), 1e-9);
    ASSERT_LE((transition.x(1e-12) - x).norm(), 1e-6 * (1.0 + x.norm()));
  }
}

TEST(SoftLevels, LevelsAboveASoftOneDoNotFeelIt) {
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Hierarchy hierarchy = random_hierarchy(seed);
    SoftLevels levels(hierarchy);
    LexicographicSolver solver(hierarchy);
    const std::vector<double> before = residuals(solver.solve(hierarchy));
    const Hierarchy& halfway = levels.update(hierarchy, kOne, 0.5);
    const Solution& solution = solver.solve(halfway);
    ASSERT_LE(worst_stationarity(certify(halfway, solution.x)), 1e-9);
    for (std::size_t k = 0; k < 2; ++k) ASSERT_NEAR(solution.levels[k].residual, before[k], 1e-9);
  }
}

TEST(SoftLevels, InATableOneHierarchyXHasNoJump) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Hierarchy hierarchy = make_hierarchy(30, table_one_levels(random, 4, 0.5));
    constexpr std::array<std::size_t, 1> kSoft{6};
    Transition transition(hierarchy, kSoft);
    const double size = 1.0 + transition.x(0.0).norm() + transition.x(1.0).norm();
    for (int i = 0; i < 10; ++i) {
      ASSERT_LE(change_at_the_steepest_place(transition, 0.1 * i, 0.1 * (i + 1)), 1e-5 * size);
    }
  }
}

TEST(SoftLevels, NothingIsAllocatedDuringATransition) {
  RandomMatrices random(3);
  const Hierarchy hierarchy = make_hierarchy(30, table_one_levels(random, 4, 0.5));
  SoftLevels levels(hierarchy);
  const MallocCounter counter;
  for (const double share : {0.0, 0.3, 0.7, 1.0}) (void)levels.update(hierarchy, kTwo, share);
  EXPECT_EQ(counter.count(), 0u);
}

TEST(SoftLevels, AHierarchyBeyondTheCapacityComesBackAsItIs) {
  Hierarchy small(2);
  small.add_level("", 1);
  const Hierarchy large = random_hierarchy(1);
  SoftLevels levels(small);
  EXPECT_EQ(&levels.update(large, kOne, 0.5), &large);
}

}  // namespace
}  // namespace surefoot::test
