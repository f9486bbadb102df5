#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot {

/// Reads a scenario's terrain: the friction and named elements, each with its `shape`
/// (plane, box, height_field, random_boxes, friction_tiles; steps: a flight of 1 … n steps; slope:
/// level ground, then a tilted plane). Without elements it is the plane z = 0.
void read_terrain(Section& section, TerrainOptions& terrain);

}  // namespace surefoot
