#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

namespace surefoot::solver {

/// Comparison of another answer to a hierarchy with one, by the residuals of its levels.
struct AnswerComparison {
  bool is_better = false;  ///< smaller residual in the first level that differs beyond rounding
  bool differs = false;    ///< in some level, by more than a negligible amount
};

/// Compares two solutions of this hierarchy. Does not allocate.
[[nodiscard]] AnswerComparison compare(const Hierarchy& hierarchy, const Solution& one,
                                       const Solution& other);

}  // namespace surefoot::solver
