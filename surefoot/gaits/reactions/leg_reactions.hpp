#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// The answer to what a leg has noticed. A foot that touches stands there, unless probe, reflex or
/// collision have it go on. One that was caught goes back, higher and over; one that finds no
/// ground goes back to where it stood. One that lost its ground searches, as does the one in the
/// air.
[[nodiscard]] std::optional<Action> react_to_leg(LegEvent event, const Situation& now, Leg leg);

/// A front foot that meets no ground at its first touch reaches beyond the edge.
[[nodiscard]] std::optional<Action> reach_beyond_edge(const Situation& now);

/// The leg did not unload, or the others can't hold the robot without it: it carries again.
[[nodiscard]] std::optional<Action> abort_lift_off(const Situation& now);

}  // namespace surefoot::gaits
