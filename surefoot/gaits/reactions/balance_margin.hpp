#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/parts/support_region.hpp"

namespace surefoot {

/// Of all feet where they are, without one.
[[nodiscard]] SupportRegion region_without(Leg leg, const Dynamics& dynamics);
/// Of the capture point in the region of all feet, as if all of them stood [m].
[[nodiscard]] double balance_margin(const Body& body, const Dynamics& dynamics);
/// Does the robot keep its balance when this leg lifts off?
[[nodiscard]] bool is_balanced_without(Leg leg, const Body& body, const Dynamics& dynamics);

}  // namespace surefoot
