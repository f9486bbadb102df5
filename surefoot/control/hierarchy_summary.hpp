#pragma once

#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/solver/blockers.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <span>

namespace surefoot::control {

/// Residuals of a solution, its active inequality rows and by how much they are beyond their
/// bounds, and the equality rows that were missed, as plain data, for the log: of these at most
/// three a level, the worst, and those that miss at least a tenth of it. Does not allocate.
void summarise(const solver::Solution& solution, const solver::Hierarchy& hierarchy,
               HierarchyReport& report) noexcept;

/// Adds the dearest rows that hold each level back, at most three a level: the dearest, and those
/// that cost at least a tenth of it; of rows that hold the same, and cost nothing alone, three too.
/// After `summarise`; empty `blockers`: nothing is known.
void summarise_blockers(std::span<const solver::LevelBlockers> blockers,
                        const solver::Hierarchy& hierarchy, HierarchyReport& report) noexcept;

}  // namespace surefoot::control
