#pragma once

#include "surefoot/explain/tick_explanation.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace surefoot {

/// A tick for people: first the sentence that says what gave way to what, then state, command,
/// feet, levels, rows at a bound and the events around it.
[[nodiscard]] std::string tick_text(const std::string& path, const TickExplanation& explanation);

/// The same, whole, for programs: the tick's messages as they stand in the log, and what was made
/// of them. SI units.
[[nodiscard]] nlohmann::ordered_json tick_json(const std::string& path,
                                               const TickExplanation& explanation);

/// Each with `time`, `text`, `leg` (null: none) and `by`.
[[nodiscard]] nlohmann::ordered_json events_json(const std::vector<NearbyEvent>& events);

/// Of that what gave way to what: `time`, `sentence`, `gave_way`, `costs_are_exact` and
/// `why_estimates`.
[[nodiscard]] nlohmann::ordered_json gave_way_json(const TickExplanation& explanation);

}  // namespace surefoot
