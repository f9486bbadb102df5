#pragma once

#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/solver/blockers.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <span>

namespace surefoot::control {

/// Writes for the log a solution's residuals, its active inequality rows with their violations, and
/// the equality rows with the largest errors: at most three a level, each at least a tenth of the
/// largest. Does not allocate.
void summarise(const solver::Solution& solution, const solver::Hierarchy& hierarchy,
               HierarchyReport& report) noexcept;

/// Adds the rows that block each level most: at most three a level, each at least a tenth as costly
/// as the costliest, or three redundant rows, which cost nothing alone. Call after `summarise`;
/// empty `blockers`: unknown.
void summarise_blockers(std::span<const solver::LevelBlockers> blockers,
                        const solver::Hierarchy& hierarchy, HierarchyReport& report) noexcept;

}  // namespace surefoot::control
