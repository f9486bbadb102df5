#pragma once

#include "surefoot/explain/tick_explanation.hpp"

#include <functional>
#include <string>

namespace surefoot {

/// Puts exact costs in the place of the control loop's estimates: the log's controller is computed
/// again up to the tick, or of a blend to the ticks beside it, and what `solve --explain` says of
/// their hierarchies is told. Where that can't be done `why_estimates` says why, and the estimates
/// stay. Does nothing where no level gave way. Takes about as long as a replay up to the tick;
/// `stops` is asked at each tick of it whether to leave it at that.
void find_exact_costs(
    const std::string& path, TickExplanation& explanation,
    const std::function<bool()>& stops = [] { return false; });

}  // namespace surefoot
