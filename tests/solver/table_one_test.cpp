#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 30;
enum LevelIndex : std::size_t { kDynamics = 0, kContacts = 1, kForces = 10 };

/// Feet down 2 to 4.
template <typename Solver>
class TableOne : public testing::Test {};
TYPED_TEST_SUITE(TableOne, Solvers);

TYPED_TEST(TableOne, EveryLevelOfRandomStacksIsOptimalAndHasTheFreedomThatRemains) {
  for (const double aggression : {0.0, 0.5, 1.0}) {  // from few to many active limits
    for (SeededRandom& random : Seeds(200)) {
      const HierarchyData levels = walk_levels(random, aggression);
      const Solution solution = solve<TypeParam>(kUnknowns, levels);
      ASSERT_EQ(solution.status, SolveStatus::optimal);
      ASSERT_LE(optimality_error(kUnknowns, levels, solution.x), 1e-9);
      ASSERT_EQ(solution.levels[kContacts].degrees_of_freedom_left, 12);
      ASSERT_NEAR(solution.levels[kDynamics].residual, 0.0, 1e-10);
      ASSERT_NEAR(solution.levels[kContacts].residual, 0.0, 1e-10);
      if (random.seed() % 3 != 2) continue;  // four feet down
      ASSERT_EQ(solution.levels[kForces].degrees_of_freedom_left, 0);
    }
  }
}

}  // namespace
}  // namespace surefoot::solver
