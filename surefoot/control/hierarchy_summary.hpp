#pragma once

#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

namespace surefoot {

/// Residuals and active inequality rows of a solution as plain data, for the log. Does not
/// allocate.
void summarise(const Solution& solution, const Hierarchy& hierarchy,
               HierarchyReport& report) noexcept;

}  // namespace surefoot
