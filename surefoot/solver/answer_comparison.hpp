#pragma once

#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

namespace surefoot {

/// How another answer to a hierarchy compares with one, by the residuals of its levels.
struct AnswerComparison {
  bool is_better = false;  ///< where the first level differs by more than rounding, it has less
  bool differs = false;    ///< in a level, by more than makes no difference
};

/// Of two solutions of this hierarchy. Does not allocate.
[[nodiscard]] AnswerComparison compare(const Hierarchy& hierarchy, const Solution& one,
                                       const Solution& other);

}  // namespace surefoot
