#include "tests/solver/brute_force.hpp"

#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

namespace surefoot::solver {
namespace {

/// Rows in all levels, so that the enumeration stays small.
Index total_rows(const HierarchyData& levels) {
  Index rows = 0;
  for (const LevelData& level : levels) rows += level.lower.size();
  return rows;
}

/// Drops the last levels until at most `rows` remain.
HierarchyData shortened(HierarchyData levels, Index rows) {
  while (total_rows(levels) > rows) levels.pop_back();
  return levels;
}

template <typename Solver>
void expect_agreement(const RandomOptions& options, int num_seeds, Index max_rows) {
  for (SeededRandom& random : Seeds(num_seeds)) {
    RandomOptions sized = options;
    sized.unknowns = random.integer(1, 4);
    const HierarchyData levels = shortened(random_levels(random, sized), max_rows);
    const Solution solution = solve<Solver>(sized.unknowns, levels);
    const std::vector<double> truth = brute_force_residuals(sized.unknowns, levels);
    ASSERT_EQ(solution.status, SolveStatus::optimal);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      ASSERT_NEAR(solution.levels[k].residual, truth[k], 1e-7 * (1.0 + truth[k])) << "level " << k;
    }
  }
}

template <typename Solver>
class AgainstBruteForce : public testing::Test {};
TYPED_TEST_SUITE(AgainstBruteForce, Solvers);

TYPED_TEST(AgainstBruteForce, AgreesOnMixedHierarchies) {
  expect_agreement<TypeParam>({.levels = 4, .max_rows = 3, .inequality_share = 0.7}, 400, 7);
}

TYPED_TEST(AgainstBruteForce, AgreesOnManyLevelsOfOneRow) {
  expect_agreement<TypeParam>({.levels = 8, .max_rows = 1, .inequality_share = 0.9}, 300, 7);
}

TYPED_TEST(AgainstBruteForce, AgreesOnOneCrowdedLevel) {
  expect_agreement<TypeParam>(
      {.levels = 1, .max_rows = 6, .inequality_share = 0.8, .two_sided_share = 0.2}, 150, 6);
}

TYPED_TEST(AgainstBruteForce, AgreesOnDuplicatedDependentAndZeroRows) {
  expect_agreement<TypeParam>({.levels = 4,
                               .max_rows = 3,
                               .inequality_share = 0.7,
                               .duplicate_share = 0.3,
                               .dependent_share = 0.2,
                               .zero_share = 0.1},
                              400, 7);
}

TYPED_TEST(AgainstBruteForce, AgreesWhereManyBoundsShareAVertex) {
  expect_agreement<TypeParam>({.levels = 3,
                               .max_rows = 4,
                               .inequality_share = 0.9,
                               .two_sided_share = 0.1,
                               .tight_share = 0.8,
                               .integer_share = 1.0},
                              400, 7);
}

}  // namespace
}  // namespace surefoot::solver
