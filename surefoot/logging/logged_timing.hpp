#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <vector>

namespace surefoot::logged {

/// What the log has of a tick's timing, whose levels have these names, highest priority first. No
/// level stands in it where none was measured.
[[nodiscard]] Timing timing_of(const TickTiming& timing, const std::vector<std::string>& names);

/// The same back, with the levels in the order of `names`, whatever theirs was.
[[nodiscard]] TickTiming timing_from(const Timing& timing, const std::vector<std::string>& names);

}  // namespace surefoot::logged
