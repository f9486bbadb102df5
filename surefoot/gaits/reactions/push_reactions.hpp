#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Does the robot keep its balance when this leg lifts off?
[[nodiscard]] bool is_balanced_without(Leg leg, const Situation& now);

/// Pushed in a swing so that the balance is lost before the foot lands by itself: it comes down at
/// once.
[[nodiscard]] std::optional<Action> land_if_tipping(const Situation& now);
/// Pushed before a lift-off: the leg carries again.
[[nodiscard]] std::optional<Action> reload_if_pushed(const Situation& now);
/// Pushed out of balance on all feet: a step of the foot after which the robot is balanced best, if
/// one helps.
[[nodiscard]] std::optional<Action> step_to_recover(const Situation& now);
/// A robot that has come to rest, well inside its feet, under a force that stays, goes on.
[[nodiscard]] std::optional<Action> go_on_if_calm(const Situation& now);
/// Feet have begun or ceased to slide: a leg that was to lift off carries again, one in the air
/// comes down where the others can't do without it.
[[nodiscard]] std::optional<Action> on_slip(const Situation& now);

}  // namespace surefoot::gaits
