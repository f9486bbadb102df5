#pragma once

#include "surefoot/model/description.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// Where the controller's model of a robot and MuJoCo's own, of the same URDF or MJCF without
/// armature, differ; of a URDF that MuJoCo refuses, the one that the physics reads. They differ by
/// more than 1e-9 of a quantity, a line each. First the inertia of each body; then, at random
/// postures within the limits, places and axes of joints and feet; and where these agree, centre of
/// mass, M(q) and what gravity asks. Throws Error as `build_model` does.
[[nodiscard]] std::vector<std::string> disagreements(const model::RobotDescription& robot,
                                                     int num_postures);

/// Does MuJoCo read the robot's URDF or MJCF by itself? Else its own model is of what we write.
[[nodiscard]] bool is_read_by_mujoco(const model::RobotDescription& robot);

}  // namespace surefoot::simulation
