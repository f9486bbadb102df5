#pragma once

#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Throws Error on the first invalid option: its name, its value, and what would be valid.
void check_options(const PlantOptions& given);

/// Physics steps in a control period; throws Error if it is not a whole number.
[[nodiscard]] int steps_per_period(const PlantOptions& options);

}  // namespace surefoot::simulation
