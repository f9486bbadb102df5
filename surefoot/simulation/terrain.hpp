#pragma once

#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Group of the terrain's geoms, the only one that ground rays hit.
inline constexpr int kTerrainGroup = 0;
/// Group of the robot's geoms.
inline constexpr int kRobotGroup = 1;

/// Adds the terrain to the world; the plane z = 0 if there is no element.
///
/// Terrain has a higher contact priority than the robot, so that the terrain element alone sets a
/// contact's friction and stiffness (MuJoCo otherwise takes the larger friction of the two).
void add_terrain(mjSpec& spec, const TerrainOptions& terrain, const ContactOptions& contact);

/// Height of the terrain at (x, y) by a ray from above [m]; NaN without terrain.
[[nodiscard]] double terrain_height(const mjModel& model, const mjData& data, double x, double y);

/// Height of a sphere's centre over (x, y) when it rests on the terrain [m]; NaN without terrain.
[[nodiscard]] double resting_height(const mjModel& model, const mjData& data, double x, double y,
                                    double radius);

}  // namespace surefoot::simulation
