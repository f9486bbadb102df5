#pragma once

#include "surefoot/logging/tick_clock.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::cli {

/// Sentences, each on a line, on a clock that does not begin at 0 or skips; empty where it does
/// neither.
[[nodiscard]] std::string clock_text(const logging::ClockSkips& clock);

/// The same as the member "clock"; nothing where the text is empty.
void add_clock(const logging::ClockSkips& clock, nlohmann::ordered_json& json);

/// A time as one writes it: 12.405 for what rounding has made 12.405000000000001 of. To the
/// nanosecond, as messages of a log have it [s].
[[nodiscard]] double to_nanosecond(double time);

}  // namespace surefoot::cli
