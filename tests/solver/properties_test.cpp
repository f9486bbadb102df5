#include "tests/solver/solve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace surefoot::solver {
namespace {

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

/// So it has with each level in another form.
template <typename Solver, typename Change>
void expect_same_x_with(const Change& change) {
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Case<Solver> original(seed);
    HierarchyData changed;
    for (const LevelData& level : original.levels)
      changed.push_back(change(original.random, level));
    expect_same_x(original, changed);
  }
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

/// Levels of rows that are parallel to within `distance`, half of them limits within 1.
HierarchyData nearly_parallel_levels(RandomMatrices& random, Index unknowns, double distance) {
  const MatrixXd base = random.matrix(std::max<Index>(1, unknowns / 2), unknowns);
  HierarchyData levels;
  for (int k = random.integer(2, 4); k > 0; --k) {
    const Index rows = random.integer(1, 10);
    LevelData level{distance * random.matrix(rows, unknowns), random.vector(rows), {}};
    level.upper = level.lower;
    for (Index i = 0; i < rows; ++i) {
      const Index parallel = random.integer(0, static_cast<int>(base.rows()) - 1);
      level.A.row(i) += (random.chance(0.5) ? 1.0 : -1.0) * base.row(parallel);
      if (!random.chance(0.7)) continue;
      level.lower[i] = random.chance(0.3) ? -kInfinity : level.lower[i] - random.uniform(0.0, 1.0);
      level.upper[i] = random.chance(0.3) ? kInfinity : level.upper[i] + random.uniform(0.0, 1.0);
    }
    levels.push_back(level);
  }
  return levels;
}

// x is 1e5 and more, and still the rows of the levels above hold it.
TYPED_TEST(Properties, NearlyParallelRowsBelowCostNoLevelAbove) {
  for (SeededRandom& random : Seeds(2 * kSeeds)) {
    const Index unknowns = random.integer(3, 11);
    const HierarchyData levels = nearly_parallel_levels(random, unknowns, 1e-5);
    const Solution all = solve<TypeParam>(unknowns, levels);
    for (std::size_t k = 1; k < levels.size(); ++k) {
      const HierarchyData part(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(k));
      const double alone = solve<TypeParam>(unknowns, part).levels.back().residual;
      const double rounding = 1e-6 * (1.0 + alone) + 1e-12 * all.x.norm();
      ASSERT_LE(all.levels[k - 1].residual, alone + rounding) << "level " << k;
    }
  }
}

// All three rows of the first level can be met, with an x of 5e6. Beside that a motion that
// violates one of them by 0.6 is slow, and still no rounding.
TYPED_TEST(Properties, ASlowMotionOfARowAboveIsNotTakenForRounding) {
  const HierarchyData levels{
      {.A = MatrixXd{{-0.397209608, 0.20785417, 0.950544461, -1.163011492, -0.362974821},
                     {0.397209377, -0.20785438, -0.950545194, 1.163011658, 0.362975064},
                     {0.397209116, -0.207855296, -0.950546211, 1.163010387, 0.362973983},
                     {-0.397210606, 0.207854252, 0.950545671, -1.163012467, -0.362975812}},
       .lower = VectorXd{{0.423, 0.945, -0.795, 0.955}},
       .upper = VectorXd{{0.423, 0.945, -0.795, 1.587}}},
      {.A = MatrixXd{{-0.39721101, 0.207855231, 0.950544099, -1.163009779, -0.362975169},
                     {0.397209875, -0.207853317, -0.950545393, 1.163011188, 0.362975551},
                     {0.397210592, -0.20785437, -0.950543118, 1.16301164, 0.362976299},
                     {1.056229357, -0.727426498, 0.429922903, 0.370874374, -0.430956244},
                     {-0.397210946, 0.207855117, 0.950546815, -1.163011952, -0.362973436}},
       .lower = VectorXd{{1.518, -kInfinity, -0.94, 0.728, -1.028}},
       .upper = VectorXd{{1.518, 0.848, 0.747, 1.972, -0.049}}},
      {.A = MatrixXd{{-1.056230353, 0.727425035, -0.429922958, -0.37087593, 0.430955661}},
       .lower = VectorXd{{-1.198}},
       .upper = VectorXd{{0.708}}},
  };
  const Solution all = solve<TypeParam>(5, levels);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const HierarchyData part(levels.begin(), levels.begin() + static_cast<std::ptrdiff_t>(k));
    const double alone = solve<TypeParam>(5, part).levels.back().residual;
    EXPECT_NEAR(all.levels[k - 1].residual, alone, 1e-6 * (1.0 + alone)) << "level " << k;
  }
}

TYPED_TEST(Properties, TheOrderOfRowsInALevelDoesNotMatter) {
  expect_same_x_with<TypeParam>([](RandomMatrices&, const LevelData& level) {
    std::vector<Index> order(static_cast<std::size_t>(level.lower.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::reverse(order.begin(), order.end());
    if (order.size() > 2) std::swap(order[0], order[1]);
    return reordered(level, order);
  });
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
  expect_same_x_with<TypeParam>([](RandomMatrices& random, const LevelData& level) {
    return scaled(level, std::pow(10.0, random.uniform(-6.0, 6.0)));
  });
}

TYPED_TEST(Properties, TwoHalfWeightCopiesOfALevelAreThatLevel) {
  expect_same_x_with<TypeParam>([](RandomMatrices&, const LevelData& level) {
    const LevelData half = scaled(level, std::sqrt(0.5));
    return joined(half, half);
  });
}

TYPED_TEST(Properties, AnEqualityIsAPairOfInequalities) {
  expect_same_x_with<TypeParam>([](RandomMatrices&, const LevelData& level) {
    const VectorXd open = VectorXd::Constant(level.lower.size(), kInfinity);
    return joined(between(level.A, -open, level.upper), between(level.A, level.lower, open));
  });
}

TYPED_TEST(Properties, ARowWithSwappedSignHasSwappedBounds) {
  expect_same_x_with<TypeParam>([](RandomMatrices&, const LevelData& level) {
    return between(-level.A, -level.upper, -level.lower);
  });
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
  for (SeededRandom& random : Seeds(kSeeds)) {
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
  for (SeededRandom& random : Seeds(kSeeds)) {
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
  for (SeededRandom& random : Seeds(100)) {
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
}  // namespace surefoot::solver
