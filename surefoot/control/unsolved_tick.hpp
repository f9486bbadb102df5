#pragma once

#include "surefoot/signals/tick_record.hpp"

namespace surefoot::control {

/// Describes a tick at which nothing was solved: the results of the last one must not be logged
/// again.
void describe_unsolved(TickRecord& record);

}  // namespace surefoot::control
