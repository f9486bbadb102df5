#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::config {

/// A scenario's terrain: the friction and named elements, each with its `shape`. Without elements
/// it is the plane z = 0.
[[nodiscard]] Group terrain_fields(simulation::TerrainOptions& terrain);

}  // namespace surefoot::config
