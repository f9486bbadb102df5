#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace surefoot::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kSeeds = 300;
constexpr Index kUnknowns = 9;

/// One random hierarchy whose last level makes x unique.
template <typename Solver>
struct Case {
  explicit Case(int seed) : random(static_cast<std::uint64_t>(seed)) {
    levels = random_levels(random, {.unknowns = kUnknowns,
                                    .levels = random.integer(1, 10),
                                    .max_rows = 5,
                                    .inequality_share = random.uniform(0.0, 1.0)});
    levels.push_back(close_to(random.vector(kUnknowns)));
    solution = solve<Solver>(kUnknowns, levels);
  }
  RandomMatrices random;
  HierarchyData levels;
  Solution solution;
};

/// The same problem in another form has the same x.
template <typename Solver>
void expect_same_x(const Case<Solver>& original, const HierarchyData& changed) {
  const Solution solution = solve<Solver>(kUnknowns, changed);
  ASSERT_EQ(solution.status, SolveStatus::optimal);
  ASSERT_LE((solution.x - original.solution.x).norm(), 1e-7 * (1.0 + original.solution.x.norm()));
}

LevelData reordered(const LevelData& level, const std::vector<Index>& order) {
  LevelData result = level;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto to = static_cast<Index>(i);
    result.A.row(to) = level.A.row(order[i]);
    result.lower[to] = level.lower[order[i]];
    result.upper[to] = level.upper[order[i]];
  }
  return result;
}

LevelData scaled(const LevelData& level, double factor) {
  return {factor * level.A, factor * level.lower, factor * level.upper};
}

template <typename Solver>
class Properties : public testing::Test {};
TYPED_TEST_SUITE(Properties, Solvers);

TYPED_TEST(Properties, EveryLevelMeetsItsOptimalityConditions) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    ASSERT_EQ(original.solution.status, SolveStatus::optimal);
    ASSERT_LE(optimality_error(kUnknowns, original.levels, original.solution.x), 1e-9);
  }
}

TYPED_TEST(Properties, AddingALowerLevelNeverChangesAHigherResidual) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    for (std::size_t k = 1; k < original.levels.size(); ++k) {
      const HierarchyData part(original.levels.begin(),
                               original.levels.begin() + static_cast<std::ptrdiff_t>(k));
      const double alone = solve<TypeParam>(kUnknowns, part).levels.back().residual;
      ASSERT_NEAR(alone, original.solution.levels[k - 1].residual, 1e-9 * (1.0 + alone));
    }
  }
}

TYPED_TEST(Properties, TheOrderOfRowsInALevelDoesNotMatter) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      std::vector<Index> order(static_cast<std::size_t>(level.lower.size()));
      std::iota(order.begin(), order.end(), Index{0});
      std::reverse(order.begin(), order.end());
      if (order.size() > 2) std::swap(order[0], order[1]);
      changed.push_back(reordered(level, order));
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, AnOrthogonalChangeOfUnknownsCarriesOver) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<TypeParam> original(seed);
    const MatrixXd Q = original.random.rotation(kUnknowns);
    HierarchyData changed = original.levels;
    for (LevelData& level : changed) level.A = (level.A * Q).eval();
    const Solution solution = solve<TypeParam>(kUnknowns, changed);
    const VectorXd& x = original.solution.x;
    ASSERT_LE((Q * solution.x - x).norm(), 1e-7 * (1.0 + x.norm()));
  }
}

TYPED_TEST(Properties, AFactorOnAllRowsOfALevelChangesNothing) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      changed.push_back(scaled(level, std::pow(10.0, original.random.uniform(-6.0, 6.0))));
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, TwoHalfWeightCopiesOfALevelAreThatLevel) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      const LevelData half = scaled(level, std::sqrt(0.5));
      changed.push_back(joined(half, half));
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, AnEqualityIsAPairOfInequalities) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      const VectorXd open = VectorXd::Constant(level.lower.size(), kInfinity);
      changed.push_back(
          joined(between(level.A, -open, level.upper), between(level.A, level.lower, open)));
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, ARowWithSwappedSignHasSwappedBounds) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      changed.push_back(between(-level.A, -level.upper, -level.lower));
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, ALevelThatIsSatisfiedAnywayChangesNothing) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<TypeParam> original(seed);
    const MatrixXd A = original.random.matrix(4, kUnknowns);
    const VectorXd value = A * original.solution.x;
    HierarchyData changed = original.levels;
    const int where = original.random.integer(0, static_cast<int>(changed.size()));
    changed.insert(changed.begin() + where, between(A, value.array() - 0.5, value.array() + 0.5));
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, LevelsWithoutRowsChangeNothing) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels) {
      changed.push_back({MatrixXd(0, kUnknowns), VectorXd(0), VectorXd(0)});
      changed.push_back(level);
    }
    expect_same_x(original, changed);
  }
}

TYPED_TEST(Properties, AShiftOfTheOriginShiftsX) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<TypeParam> original(seed);
    const VectorXd shift = original.random.vector(kUnknowns);
    HierarchyData changed = original.levels;
    for (LevelData& level : changed) {
      level.lower += level.A * shift;
      level.upper += level.A * shift;
    }
    const Solution solution = solve<TypeParam>(kUnknowns, changed);
    const VectorXd& x = original.solution.x;
    ASSERT_LE((solution.x - shift - x).norm(), 1e-7 * (1.0 + x.norm()));
  }
}

TYPED_TEST(Properties, RowsOfOneRowLevelsMayHaveAnyScale) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    HierarchyData levels = random_levels(
        random, {.unknowns = kUnknowns, .levels = 12, .max_rows = 1, .inequality_share = 0.6});
    levels.push_back(close_to(random.vector(kUnknowns)));
    HierarchyData changed;
    for (const LevelData& level : levels) {
      changed.push_back(scaled(level, std::pow(10.0, random.uniform(-6.0, 6.0))));
    }
    const Solution plain = solve<TypeParam>(kUnknowns, levels);
    const Solution other = solve<TypeParam>(kUnknowns, changed);
    ASSERT_LE((plain.x - other.x).norm(), 1e-7 * (1.0 + plain.x.norm()));
  }
}

TYPED_TEST(Properties, RowsOfMixedScaleInALevelAreAllMetWhereTheyCanBe) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    const VectorXd x = random.vector(kUnknowns);
    HierarchyData levels;
    for (int k = 0; k < 3; ++k) {
      MatrixXd A = random.matrix(3, kUnknowns);
      for (Index i = 0; i < A.rows(); ++i) A.row(i) *= std::pow(10.0, random.uniform(-6.0, 6.0));
      levels.push_back(equalities(A, A * x));
    }
    const Solution solution = solve<TypeParam>(kUnknowns, levels);
    ASSERT_LE((solution.x - x).norm(), 1e-8 * (1.0 + x.norm()));
  }
}

TYPED_TEST(Properties, ConflictingRowsOfMixedScaleAreWeighed) {
  // Weights from 1 to 1e8 between a row and its contradiction: x is their weighted mean.
  for (const double weight : {1.0, 1e1, 1e2, 1e3, 1e4}) {
    const MatrixXd A = (MatrixXd(2, 1) << weight, 1.0).finished();
    const VectorXd b = (VectorXd(2) << weight, 2.0).finished();
    const double mean = (weight * weight + 2.0) / (weight * weight + 1.0);
    EXPECT_NEAR(solve<TypeParam>(1, {equalities(A, b)}).x[0], mean, 1e-14) << weight;
  }
}

TYPED_TEST(Properties, LightRowsBesideHeavyOnesKeepTheirSay) {
  // Heavy rows that agree act like a level above; the light rows after them are in conflict.
  constexpr double kWeight = 1e10;
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomMatrices random(static_cast<std::uint64_t>(seed));
    MatrixXd heavy = random.matrix(3, 4);
    heavy.row(2) = heavy.row(0) + heavy.row(1);
    const LevelData above = equalities(heavy, heavy * random.vector(4));
    const LevelData light = equalities(random.matrix(5, 4), random.vector(5));
    const Solution two_levels = solve<TypeParam>(4, {above, light});
    const Solution one_level = solve<TypeParam>(4, {joined(light, scaled(above, kWeight))});
    ASSERT_LE((two_levels.x - one_level.x).norm(), 1e-8 * (1.0 + two_levels.x.norm()));
  }
}

TYPED_TEST(Properties, DegreesOfFreedomNeverIncreaseAndNeverGoBelowZero) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case<TypeParam> original(seed);
    Index before = kUnknowns;
    for (const LevelResult& level : original.solution.levels) {
      ASSERT_LE(level.degrees_of_freedom_left, before);
      ASSERT_GE(level.degrees_of_freedom_left, 0);
      before = level.degrees_of_freedom_left;
    }
    ASSERT_EQ(before, 0);
  }
}

}  // namespace
}  // namespace surefoot::test
