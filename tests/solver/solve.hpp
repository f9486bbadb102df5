#pragma once

#include "surefoot/solver/cascade_solver.hpp"
#include "surefoot/solver/certificate.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::test {

/// A fresh solver's answer.
inline Solution solve(Eigen::Index unknowns, const HierarchyData& levels,
                      const CascadeOptions& options = {}) {
  const Hierarchy hierarchy = make_hierarchy(unknowns, levels);
  CascadeSolver solver(hierarchy, options);
  return solver.solve(hierarchy);
}

inline std::vector<double> residuals(const Solution& solution) {
  std::vector<double> all;
  for (const LevelResult& level : solution.levels) all.push_back(level.residual);
  return all;
}

/// Largest distance of any level from its optimality conditions.
inline double optimality_error(Eigen::Index unknowns, const HierarchyData& levels,
                               const Eigen::VectorXd& x) {
  return worst_stationarity(certify(make_hierarchy(unknowns, levels), x));
}

/// A last level that leaves no freedom: x close to `reference`. The optimum is unique then.
inline LevelData close_to(const Eigen::VectorXd& reference) {
  return equalities(Eigen::MatrixXd::Identity(reference.size(), reference.size()), reference);
}

}  // namespace surefoot::test
