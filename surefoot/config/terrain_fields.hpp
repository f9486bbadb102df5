#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::config {

/// Keys of a scenario's terrain: friction and named elements. The default is the plane z = 0.
[[nodiscard]] Group terrain_fields(simulation::TerrainOptions& terrain);

}  // namespace surefoot::config
