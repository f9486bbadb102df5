#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot {

/// Reads the sections of a scenario that describe the plant: timestep, terrain, foot_contact,
/// actuators, sensors, disturbances. The rest of PlantOptions follows from other keys of the
/// scenario.
void read_plant(Section& scenario, PlantOptions& options);

}  // namespace surefoot
