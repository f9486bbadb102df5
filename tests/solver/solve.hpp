#pragma once

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/seeds.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace surefoot::solver {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::RowVector2d;
using Eigen::RowVector3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

using test::HierarchyData;
using test::LevelData;
using test::MallocCounter;
using test::RandomMatrices;
using test::RandomOptions;
using test::SeededRandom;
using test::Seeds;

using test::at_most;
using test::between;
using test::equalities;
using test::joined;
using test::make_hierarchy;
using test::random_levels;
using test::table_one_levels;

/// All that promise the lexicographic optimum; each passes the same tests.
using Solvers = testing::Types<CascadeSolver, LexicographicSolver>;

template <typename Solver>
struct OptionsOf;
template <>
struct OptionsOf<CascadeSolver> {
  using Type = CascadeOptions;
};
template <>
struct OptionsOf<LexicographicSolver> {
  using Type = LexicographicOptions;
};
template <typename Solver>
using Options = typename OptionsOf<Solver>::Type;

/// Options that end the search early: the cascade after so many iterations in a level, the sweeps
/// after a budget that is about as much.
template <typename Solver>
Options<Solver> limited(int iterations) {
  Options<Solver> options;
  if constexpr (std::is_same_v<Solver, LexicographicSolver>) {
    options.budget.flops = 3e3 * iterations;
  } else {
    options.max_iterations = iterations;
  }
  return options;
}

/// A fresh solver's answer.
template <typename Solver = CascadeSolver>
Solution solve(Index unknowns, const HierarchyData& levels, const Options<Solver>& options = {}) {
  const Hierarchy hierarchy = make_hierarchy(unknowns, levels);
  Solver solver(hierarchy, options);
  return solver.solve(hierarchy);
}

inline std::vector<double> residuals(const Solution& solution) {
  std::vector<double> all;
  for (const LevelResult& level : solution.levels) all.push_back(level.residual);
  return all;
}

/// Bounds of a single row.
inline VectorXd number(double b) { return VectorXd::Constant(1, b); }

/// What is proven counts 1e-8 at most, rounding a hundredth of it.
inline constexpr double kProven = 1e-9;

/// Largest distance of any level from its optimality conditions.
inline double optimality_error(Index unknowns, const HierarchyData& levels, const VectorXd& x) {
  return worst_stationarity(certify(make_hierarchy(unknowns, levels), x));
}

/// The levels of Table I with two to four feet down, by the seed.
inline HierarchyData walk_levels(SeededRandom& random, double aggression) {
  return table_one_levels(random, 2 + random.seed() % 3, aggression);
}

/// A last level that leaves no freedom: x close to `reference`. The optimum is unique then.
inline LevelData close_to(const VectorXd& reference) {
  return equalities(MatrixXd::Identity(reference.size(), reference.size()), reference);
}

}  // namespace surefoot::solver
