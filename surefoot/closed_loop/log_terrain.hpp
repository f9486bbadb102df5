#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <vector>

namespace surefoot::closed_loop {

/// The ground as the plant makes it, piece by piece: random boxes one by one, generated heights
/// filled in, the plane z = 0 if there is no element.
[[nodiscard]] std::vector<logging::LogTerrain> log_terrain(
    const simulation::TerrainOptions& terrain);

}  // namespace surefoot::closed_loop
