#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <algorithm>

namespace surefoot {

/// The room that a hierarchy has, and that others need for it.

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

/// x = 0, and room for what all rows do.
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

/// Whether the solution has room for what all rows of the hierarchy do.
inline bool fits(const Hierarchy& hierarchy, const Solution& solution) {
  if (hierarchy.unknowns() != solution.x.size()) return false;
  if (hierarchy.num_levels() > solution.levels.size()) return false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const auto rows = static_cast<std::size_t>(hierarchy.level(k).num_rows());
    if (rows > solution.levels[k].rows.size()) return false;
  }
  return true;
}

}  // namespace surefoot
