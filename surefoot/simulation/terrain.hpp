#pragma once

#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Group of the terrain's geoms: rays that measure the ground see only this one.
inline constexpr int kTerrainGroup = 0;
/// Group of the robot's geoms.
inline constexpr int kRobotGroup = 1;

/// Adds the terrain to the world; the plane z = 0 if there is no element.
///
/// Terrain has a higher contact priority than the robot, so that a contact's friction and stiffness
/// are those of the terrain element alone (MuJoCo otherwise takes the larger friction of the two).
void add_terrain(mjSpec& spec, const TerrainOptions& terrain, const ContactOptions& contact);

/// Height of the terrain at (x, y) by a ray from above [m]; NaN where there is none.
[[nodiscard]] double terrain_height(const mjModel& model, const mjData& data, double x, double y);

/// Lowest z of the centre of a sphere over (x, y) that touches the terrain without entering it [m];
/// NaN where there is none.
[[nodiscard]] double resting_height(const mjModel& model, const mjData& data, double x, double y,
                                    double radius);

}  // namespace surefoot::simulation
