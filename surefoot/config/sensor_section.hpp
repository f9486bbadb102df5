#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot {

/// Reads a scenario's sensors: one section each, and named `faults`.
void read_sensors(Section& section, SensorOptions& sensors);

}  // namespace surefoot
