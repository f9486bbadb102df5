#pragma once

#include "surefoot/logging/tick_clock.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::logging {

/// A line each if a clock does not begin at 0, and if it skips; else empty.
[[nodiscard]] std::string clock_text(const ClockSkips& clock);

/// Adds the same as member "clock"; nothing if the text is empty.
void add_clock(const ClockSkips& clock, nlohmann::ordered_json& json);

/// A time [s] rounded to the nanosecond, as in a log's messages: 12.405 for 12.405000000000001.
[[nodiscard]] double to_nanosecond(double time);

}  // namespace surefoot::logging
