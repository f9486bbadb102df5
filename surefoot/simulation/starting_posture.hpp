#pragma once

#include "surefoot/simulation/robot_parts.hpp"

#include <string>

namespace surefoot::simulation {

/// Names what would throw the robot over at once, before it happens. `data` is as after mj_step1,
/// with the robot where it begins. Throws Error, with `urdf` in front, if a joint lies beyond its
/// stops, if shapes of two links overlap, or if a standing leg has a shape that reaches below its
/// foot sphere.
void check_starting_posture(const mjModel& model, const mjData& data, const RobotParts& parts,
                            const std::string& urdf);

}  // namespace surefoot::simulation
