#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/crawl/step_sequence.hpp"
#include "surefoot/gaits/gait_tick.hpp"

#include <optional>

namespace surefoot {

/// Where the other feet's triangle is too thin to swing the next leg: another leg that goes first,
/// if one can and its step to its nominal place widens the triangle.
[[nodiscard]] std::optional<Leg> leg_for_wider_support(const GaitTick& tick, const Body& body,
                                                       const StepSequence& steps);

}  // namespace surefoot
