#pragma once

#include "surefoot/signals/tick_record.hpp"
#include "surefoot/solver/solution.hpp"

#include <cstdint>

namespace surefoot {

/// False where no state was believed, or the input was invalid: no force and no residual is of
/// that tick, whatever its record has.
[[nodiscard]] inline bool was_solved(const HierarchyReport& report) {
  return report.status != static_cast<std::int32_t>(SolveStatus::invalid_input);
}

}  // namespace surefoot
