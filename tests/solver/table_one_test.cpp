#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace surefoot::solver {
namespace {

constexpr Eigen::Index kUnknowns = 30;
enum LevelIndex : std::size_t { kDynamics = 0, kContacts = 1, kForces = 10 };

/// Feet down 2 to 4.
template <typename Solver>
class TableOne : public testing::Test {};
TYPED_TEST_SUITE(TableOne, test::Solvers);

/// From few to many active limits.
constexpr double kAggressions[] = {0.0, 0.5, 1.0};

test::HierarchyData random_stack(int seed, int feet, double aggression) {
  test::RandomMatrices random(static_cast<std::uint64_t>(seed));
  return test::table_one_levels(random, feet, aggression);
}

TYPED_TEST(TableOne, EveryLevelOfRandomStacksIsOptimal) {
  for (const double aggression : kAggressions) {
    for (int seed = 0; seed < 200; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const test::HierarchyData levels = random_stack(seed, 2 + seed % 3, aggression);
      const Solution solution = test::solve<TypeParam>(kUnknowns, levels);
      ASSERT_EQ(solution.status, SolveStatus::optimal);
      ASSERT_LE(test::optimality_error(kUnknowns, levels, solution.x), 1e-9);
    }
  }
}

TYPED_TEST(TableOne, TwelveDegreesOfFreedomRemainAfterDynamicsAndContacts) {
  for (const double aggression : kAggressions) {
    for (int seed = 0; seed < 30; ++seed) {
      const Solution solution =
          test::solve<TypeParam>(kUnknowns, random_stack(seed, 2 + seed % 3, aggression));
      ASSERT_EQ(solution.levels[kContacts].degrees_of_freedom_left, 12);
      ASSERT_NEAR(solution.levels[kDynamics].residual, 0.0, 1e-10);
      ASSERT_NEAR(solution.levels[kContacts].residual, 0.0, 1e-10);
    }
  }
}

TYPED_TEST(TableOne, TheLastLevelEndsWithAnEmptyNullSpaceWithFourFeetDown) {
  for (const double aggression : kAggressions) {
    for (int seed = 0; seed < 30; ++seed) {
      const Solution solution =
          test::solve<TypeParam>(kUnknowns, random_stack(seed, 4, aggression));
      ASSERT_EQ(solution.levels[kForces].degrees_of_freedom_left, 0);
    }
  }
}

}  // namespace
}  // namespace surefoot::solver
