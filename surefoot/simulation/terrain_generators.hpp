#pragma once

#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::simulation {

/// The boxes of a random field, the same for the same seed. Their bottoms lie 0.2 m below the
/// lowest top face.
[[nodiscard]] std::vector<TerrainBox> random_boxes(const TerrainRandomBoxes& field);

/// The field with its grid and its heights filled in, if they are to be generated: plane waves of
/// random direction and phase with about the wavelength, scaled so that the largest height is the
/// amplitude.
[[nodiscard]] TerrainHeightField with_heights(TerrainHeightField field);

}  // namespace surefoot::simulation
