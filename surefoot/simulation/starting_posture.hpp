#pragma once

#include "surefoot/simulation/robot_parts.hpp"

#include <string>

namespace surefoot::simulation {

/// Reports a starting posture that would throw the robot over. `data` is as after mj_step1, with
/// the robot at its start. Throws Error, starting with `urdf`, if a joint is beyond its stops,
/// shapes of two links overlap, or a standing leg has a shape below its foot sphere.
void check_starting_posture(const mjModel& model, const mjData& data, const RobotParts& parts,
                            const std::string& urdf);

}  // namespace surefoot::simulation
