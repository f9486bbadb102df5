#include "surefoot/base/error.hpp"
#include "surefoot/solver/extra_rows.hpp"
#include "surefoot/solver/weighted_levels.hpp"
#include "tests/solver/solve.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace surefoot::solver {
namespace {

constexpr Index kUnknowns = 8;

template <typename Solver>
Solution solve(const Hierarchy& hierarchy) {
  Solver solver(hierarchy);
  return solver.solve(hierarchy);
}

/// A hierarchy with room for more rows.
Hierarchy roomy(Index unknowns, const HierarchyData& levels, Index more_rows) {
  Hierarchy hierarchy(unknowns);
  for (const LevelData& data : levels) {
    Level& level = hierarchy.level(hierarchy.add_level(
        "level " + std::to_string(hierarchy.num_levels()), data.lower.size() + more_rows));
    Rows rows = level.add(data.lower.size(), 10);
    if (data.lower.size() > 0) rows.A = data.A;
    rows.lower = data.lower;
    rows.upper = data.upper;
  }
  return hierarchy;
}

template <typename Solver>
class Choices : public testing::Test {};
TYPED_TEST_SUITE(Choices, Solvers);

TYPED_TEST(Choices, OfTwoWishesTheHeavierOneMissesLess) {
  // x = 0 and x = 1 with weights 1 and 3: minimum of x² + 9 (x − 1)² at 0.9.
  Hierarchy hierarchy(1);
  hierarchy.add_level("wishes", 2);
  Rows rows = hierarchy.level(0).add(2, 0);
  rows.A << 1.0, 1.0;
  rows.set_equal(0, 0.0);
  rows.set_equal(1, 1.0);
  rows.weigh(1, 3.0);
  const Solution solution = solve<TypeParam>(hierarchy);
  EXPECT_NEAR(solution.x[0], 0.9, 1e-14);
  EXPECT_NEAR(solution.levels[0].residual, std::hypot(0.9, 3.0 * 0.1), 1e-14);
}

TYPED_TEST(Choices, AWeightOnAWholeLevelScalesItsResidualAndNothingElse) {
  for (SeededRandom& random : Seeds(100)) {
    HierarchyData levels = random_levels(random, {.unknowns = kUnknowns, .levels = 4});
    levels.push_back(close_to(random.vector(kUnknowns)));
    const Hierarchy plain = roomy(kUnknowns, levels, 0);
    Hierarchy weighted = plain;
    const double weight = std::pow(10.0, random.uniform(-3.0, 3.0));
    weighted.level(1).rows().weigh(weight);
    const Solution first = solve<TypeParam>(plain);
    const Solution second = solve<TypeParam>(weighted);
    ASSERT_LE((first.x - second.x).norm(), 1e-9 * (1.0 + first.x.norm()));
    const double expected = weight * first.levels[1].residual;
    ASSERT_NEAR(second.levels[1].residual, expected, 1e-9 * weight * (1.0 + first.x.norm()));
  }
}

TYPED_TEST(Choices, TheLastLevelChoosesTheClosestOfAllOptima) {
  for (SeededRandom& random : Seeds(100)) {
    const MatrixXd A = random.matrix(3, kUnknowns);
    const VectorXd b = random.vector(3), reference = random.vector(kUnknowns);
    Hierarchy hierarchy = make_hierarchy(kUnknowns, {equalities(A, b)});
    hierarchy.add_level("reference", kUnknowns);
    add_reference(hierarchy.level(1), reference, 0);
    const VectorXd closest =
        reference + A.transpose() * (A * A.transpose()).ldlt().solve(b - A * reference);
    ASSERT_LE((solve<TypeParam>(hierarchy).x - closest).norm(), 1e-9);
  }
}

/// One level of singular values 1 and σ that asks for (1, 1), a level below that wants x₁ = 5 and
/// x₂ = 3. The third direction is free.
Hierarchy singular(double sigma, double damping, const MatrixXd& turn) {
  const MatrixXd A = (MatrixXd(2, 3) << 1.0, 0.0, 0.0, 0.0, sigma, 0.0).finished() * turn;
  const MatrixXd below = (MatrixXd(2, 3) << 0.0, 1.0, 0.0, 0.0, 0.0, 1.0).finished() * turn;
  Hierarchy hierarchy =
      roomy(3, {equalities(A, Vector2d(1.0, 1.0)), equalities(below, Vector2d(5.0, 3.0))}, 2);
  add_damping(hierarchy.level(0), damping, VectorXd::Zero(3), 100);
  return hierarchy;
}

TYPED_TEST(Choices, DampingFollowsItsFormulaAtEverySingularValue) {
  for (SeededRandom& random : Seeds(40)) {
    const MatrixXd turn = random.rotation(3);
    const double damping = std::pow(10.0, random.uniform(-2.0, 0.0));
    for (int step = 0; step <= 140; step += 2) {
      const double sigma = std::pow(10.0, -0.1 * step);
      SCOPED_TRACE("singular value " + std::to_string(sigma));
      const VectorXd x = turn * solve<TypeParam>(singular(sigma, damping, turn)).x;
      ASSERT_NEAR(x[0], 1.0 / (1.0 + damping * damping), 1e-9);
      ASSERT_NEAR(x[1], sigma / (sigma * sigma + damping * damping), 1e-7);
      ASSERT_LE(std::abs(x[1]), 0.5 / damping + 1e-9);
      ASSERT_NEAR(x[2], 3.0, 1e-9) << "the level below keeps what the level leaves";
    }
  }
}

TYPED_TEST(Choices, DampingLeavesTheLevelsBelowTheSameFreedom) {
  for (SeededRandom& random : Seeds(100)) {
    HierarchyData levels;
    for (int k = 0; k < 3; ++k) {
      const Index rank = random.integer(1, 3);
      levels.push_back(
          equalities(random.matrix(3, rank) * random.matrix(rank, kUnknowns), random.vector(3)));
    }
    const Solution plain = solve<TypeParam>(roomy(kUnknowns, levels, 0));
    Hierarchy damped = roomy(kUnknowns, levels, 3);
    add_damping(damped.level(1), 0.1, random.vector(kUnknowns), 100);
    const Solution solution = solve<TypeParam>(damped);
    ASSERT_LE(worst_stationarity(certify(damped, solution.x)), 1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(solution.levels[k].degrees_of_freedom_left,
                plain.levels[k].degrees_of_freedom_left);
    }
  }
}

/// What rounding leaves of the optimality conditions of a level whose rows differ in length. A
/// value of the longest row is off by (terms of its sum) ε ‖a‖ ‖x‖; the gradient weighs that with
/// ‖a‖ again, and a certificate divides by the square of the shortest row.
double rounding_of(const Level& level) {
  const VectorXd length = level.A().rowwise().norm();
  const double ratio = length.maxCoeff() / length.minCoeff();
  const auto terms = static_cast<double>(level.num_rows() + level.A().cols());
  return terms * std::numeric_limits<double>::epsilon() * ratio * ratio;
}

TYPED_TEST(Choices, WithHeavyWeightsTheWeightedStackComesCloseToTheStrictOne) {
  // min ‖A₁ x − b₁‖² W² + ‖A₂ x − b₂‖²: the strict optimum is the limit of large W.
  for (SeededRandom& random : Seeds(50)) {
    const HierarchyData levels{at_most(random.matrix(3, 6), random.vector(3)),
                               equalities(random.matrix(3, 6), random.vector(3)),
                               equalities(random.matrix(6, 6), random.vector(6))};
    const Hierarchy strict = roomy(6, levels, 0);
    const VectorXd x = solve<TypeParam>(strict).x;
    double last = 1e9;
    for (const double weight : {1e1, 1e2, 1e3}) {
      WeightedLevels weighted(strict, 1, {weight});
      const Hierarchy& merged = weighted.update(strict);
      const Solution solution = solve<TypeParam>(merged);
      ASSERT_EQ(merged.num_levels(), 2u);
      ASSERT_LE(worst_stationarity(certify(merged, solution.x)), rounding_of(merged.level(1)));
      const double distance = (solution.x - x).norm();
      ASSERT_LE(distance, last + 1e-12);
      last = distance;
    }
    ASSERT_LE(last, 1e-2 * (1.0 + x.norm()));
  }
}

TEST(WeightedLevels, RowsKeepTheirNumbersTimesTheirWeightAndIdsOfTheirOwn) {
  RandomMatrices random(4);
  const HierarchyData levels{equalities(random.matrix(1, 4), random.vector(1)),
                             equalities(random.matrix(2, 4), random.vector(2)),
                             at_most(random.matrix(2, 4), random.vector(2))};
  const Hierarchy strict = roomy(4, levels, 0);
  WeightedLevels weighted(strict, 1, {2.0, 0.5});
  const Level& level = weighted.update(strict).level(1);
  ASSERT_EQ(level.num_rows(), 4);
  EXPECT_EQ(level.A().topRows(2), 2.0 * levels[1].A);
  EXPECT_EQ(level.upper().tail(2), 0.5 * levels[2].upper);
  EXPECT_EQ(level.id(1), 11 + WeightedLevels::kIdStride);
  EXPECT_EQ(level.id(2), 10 + 2 * WeightedLevels::kIdStride);
}

TEST(WeightedLevels, WhatCannotBeMergedIsRefused) {
  Hierarchy hierarchy(2);
  hierarchy.add_level("only", 1);
  EXPECT_THROW(WeightedLevels(hierarchy, 1), Error);
  EXPECT_THROW(WeightedLevels(hierarchy, 0, {0.0}), Error);
  EXPECT_THROW(WeightedLevels(hierarchy, 0, {std::nan("")}), Error);
}

}  // namespace
}  // namespace surefoot::solver
