#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <array>

namespace surefoot::control {

/// Describes a tick at which nothing was solved: the results of the last one must not be logged
/// again. `level_times`: of the solver [s].
void describe_unsolved(TickRecord& record, std::array<double, kMaxLevels>& level_times);

}  // namespace surefoot::control
