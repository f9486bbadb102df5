#pragma once

#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::simulation {

/// The boxes of a random field, determined by its seed. Their bottoms are 0.2 m below the lowest
/// top face.
[[nodiscard]] std::vector<TerrainBox> random_boxes(const TerrainRandomBoxes& field);

/// The field with its missing grid and heights generated: plane waves of random direction and phase
/// near the wavelength, scaled so that the largest height is the amplitude.
[[nodiscard]] TerrainHeightField with_heights(TerrainHeightField field);

}  // namespace surefoot::simulation
