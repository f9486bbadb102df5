#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::test {
namespace {

constexpr Eigen::Index kUnknowns = 30;
enum LevelIndex : std::size_t { kDynamics = 0, kContacts = 1, kForces = 10 };

/// Feet down 2 to 4, from few to many active limits.
class TableOne : public testing::TestWithParam<double> {};

TEST_P(TableOne, EveryLevelOfRandomStacksIsOptimal) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const HierarchyData levels = table_one_levels(random, 2 + seed % 3, GetParam());
    const Solution solution = solve(kUnknowns, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(kUnknowns, levels, solution.x), 1e-9);
  }
}

TEST_P(TableOne, TwelveDegreesOfFreedomRemainAfterDynamicsAndContacts) {
  for (int seed = 0; seed < 30; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Solution solution = solve(kUnknowns, table_one_levels(random, 2 + seed % 3, GetParam()));
    ASSERT_EQ(solution.levels[kContacts].degrees_of_freedom_left, 12);
    ASSERT_NEAR(solution.levels[kDynamics].residual, 0.0, 1e-10);
    ASSERT_NEAR(solution.levels[kContacts].residual, 0.0, 1e-10);
  }
}

TEST_P(TableOne, TheLastLevelEndsWithAnEmptyNullSpaceWithFourFeetDown) {
  for (int seed = 0; seed < 30; ++seed) {
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const Solution solution = solve(kUnknowns, table_one_levels(random, 4, GetParam()));
    ASSERT_EQ(solution.levels[kForces].degrees_of_freedom_left, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(FewToManyActiveLimits, TableOne, testing::Values(0.0, 0.5, 1.0));

}  // namespace
}  // namespace surefoot::test
