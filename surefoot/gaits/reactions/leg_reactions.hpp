#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Reaction to a leg's event. A foot with contact stands there, unless probing, reflex or collision
/// continue its swing. A caught foot goes back, then higher and over the obstacle. One without
/// ground returns to its last foothold. After a contact loss this and the swing foot search.
[[nodiscard]] std::optional<Action> react_to_leg(LegEvent event, const Situation& now, Leg leg);

/// A front foot that meets no ground at its first touch reaches beyond the edge.
[[nodiscard]] std::optional<Action> reach_beyond_edge(const Situation& now);

/// The leg did not unload, or the others can't carry the robot without it: it is loaded again.
[[nodiscard]] std::optional<Action> abort_lift_off(const Situation& now);

}  // namespace surefoot::gaits
