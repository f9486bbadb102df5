#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>

namespace surefoot::solver {

/// Capacities of a hierarchy, and room for its solution.

/// Of all its levels.
inline Eigen::Index max_rows(const Hierarchy& hierarchy) {
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) rows += hierarchy.level(k).max_rows();
  return rows;
}

/// Of its largest level.
inline Eigen::Index max_rows_of_a_level(const Hierarchy& hierarchy) {
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    rows = std::max(rows, hierarchy.level(k).max_rows());
  }
  return rows;
}

/// x = 0, with room for the states of all rows.
inline Solution empty_solution(const Hierarchy& capacity) {
  Solution solution;
  solution.x.setZero(capacity.unknowns());
  solution.levels.resize(capacity.num_levels());
  for (std::size_t k = 0; k < capacity.num_levels(); ++k) {
    const auto rows = static_cast<std::size_t>(capacity.level(k).max_rows());
    solution.levels[k].rows.assign(rows, RowState::inactive);
  }
  return solution;
}

/// Has the solution room for the states of the hierarchy's rows?
inline bool fits(const Hierarchy& hierarchy, const Solution& solution) {
  if (hierarchy.unknowns() != solution.x.size()) return false;
  if (hierarchy.num_levels() > solution.levels.size()) return false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const auto rows = static_cast<std::size_t>(hierarchy.level(k).num_rows());
    if (rows > solution.levels[k].rows.size()) return false;
  }
  return true;
}

}  // namespace surefoot::solver
