#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Does the robot keep its balance when this leg lifts off?
[[nodiscard]] bool is_balanced_without(Leg leg, const Situation& now);

/// Puts the swing foot down at once if a push would tip the robot before the planned touchdown.
[[nodiscard]] std::optional<Action> land_if_tipping(const Situation& now);
/// Loads an unloading leg again after a push.
[[nodiscard]] std::optional<Action> reload_if_pushed(const Situation& now);
/// Out of balance by a push with all feet down: takes the best step, if one helps.
[[nodiscard]] std::optional<Action> step_to_recover(const Situation& now);
/// Continues the gait once the robot is at rest with enough margin, under a steady force.
[[nodiscard]] std::optional<Action> go_on_if_calm(const Situation& now);
/// Feet have begun or stopped sliding: an unloading leg is loaded again, and a swing foot comes
/// down if the robot is not balanced without it.
[[nodiscard]] std::optional<Action> on_slip(const Situation& now);

}  // namespace surefoot::gaits
