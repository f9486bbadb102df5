#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <vector>

namespace surefoot::logged {

/// A tick's timing in the log, with its levels' names, highest priority first. Has no levels if
/// none was measured.
[[nodiscard]] Timing timing_of(const TickTiming& timing, const std::vector<std::string>& names);

/// The reverse, with the levels in the order of `names`.
[[nodiscard]] TickTiming timing_from(const Timing& timing, const std::vector<std::string>& names);

}  // namespace surefoot::logged
