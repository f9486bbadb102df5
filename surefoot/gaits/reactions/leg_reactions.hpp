#pragma once

#include "surefoot/gaits/reactions/action.hpp"
#include "surefoot/gaits/reactions/situation.hpp"

#include <optional>

namespace surefoot {

/// Looks at a leg as it is believed to be, and says what it notices.
[[nodiscard]] LegEvent look_at(Leg leg, const GaitTick& tick, Body& body);

/// The answer to what a leg has noticed.
[[nodiscard]] std::optional<Action> react_to_leg(LegEvent event, const Situation& now, Leg leg);

/// A foot that touches: it stands there, unless probe, reflex or collision have it go on.
[[nodiscard]] Action on_touchdown(const Situation& now, Leg leg);
/// A front foot's first touch: goes back or beyond.
[[nodiscard]] Action on_first_touch(const Situation& now, Leg leg);
/// A front foot that meets no ground at its first touch reaches beyond the edge.
[[nodiscard]] std::optional<Action> reach_beyond_edge(const Situation& now, Leg leg);
/// A hind foot that touches above ground that it knows: over the edge.
[[nodiscard]] std::optional<Action> on_collision(const Situation& now, Leg leg);
/// A foot that was caught on its way: back, higher and over.
[[nodiscard]] std::optional<Action> on_caught(const Situation& now, Leg leg);
/// Is this touch, after the foot was caught, the edge of what caught it?
[[nodiscard]] bool touches_the_edge(const Situation& now, Leg leg);
/// No ground within reach: back to where it stood.
[[nodiscard]] Action on_no_ground(const Situation& now, Leg leg);
/// A foot that should stand has lost its ground: it searches, and with it the one in the air.
[[nodiscard]] Action on_lost(const Situation& now, Leg leg);
/// A foot that came down has flown off again: there was no ground, or only an edge.
[[nodiscard]] Action on_flight(const Situation& now, Leg leg);

}  // namespace surefoot
