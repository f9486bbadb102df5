#pragma once

#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <type_traits>
#include <vector>

namespace surefoot::test {

/// All that promise the lexicographic optimum; each passes the same tests.
using Solvers = testing::Types<solver::CascadeSolver, solver::LexicographicSolver>;

template <typename Solver>
struct OptionsOf;
template <>
struct OptionsOf<solver::CascadeSolver> {
  using Type = solver::CascadeOptions;
};
template <>
struct OptionsOf<solver::LexicographicSolver> {
  using Type = solver::LexicographicOptions;
};
template <typename Solver>
using Options = typename OptionsOf<Solver>::Type;

/// Options that end the search early: the cascade after so many iterations in a level, the sweeps
/// after a budget that is about as much.
template <typename Solver>
Options<Solver> limited(int iterations) {
  Options<Solver> options;
  if constexpr (std::is_same_v<Solver, solver::LexicographicSolver>) {
    options.budget.flops = 3e3 * iterations;
  } else {
    options.max_iterations = iterations;
  }
  return options;
}

/// A fresh solver's answer.
template <typename Solver = solver::CascadeSolver>
solver::Solution solve(Eigen::Index unknowns, const HierarchyData& levels,
                       const Options<Solver>& options = {}) {
  const solver::Hierarchy hierarchy = make_hierarchy(unknowns, levels);
  Solver solver(hierarchy, options);
  return solver.solve(hierarchy);
}

inline std::vector<double> residuals(const solver::Solution& solution) {
  std::vector<double> all;
  for (const solver::LevelResult& level : solution.levels) all.push_back(level.residual);
  return all;
}

/// Bounds of a single row.
inline Eigen::VectorXd number(double b) { return Eigen::VectorXd::Constant(1, b); }

/// What is proven counts 1e-8 at most, rounding a hundredth of it.
inline constexpr double kProven = 1e-9;

/// Largest distance of any level from its optimality conditions.
inline double optimality_error(Eigen::Index unknowns, const HierarchyData& levels,
                               const Eigen::VectorXd& x) {
  return solver::worst_stationarity(solver::certify(make_hierarchy(unknowns, levels), x));
}

/// A last level that leaves no freedom: x close to `reference`. The optimum is unique then.
inline LevelData close_to(const Eigen::VectorXd& reference) {
  return equalities(Eigen::MatrixXd::Identity(reference.size(), reference.size()), reference);
}

}  // namespace surefoot::test
