#pragma once

#include "surefoot/simulation/mujoco_handles.hpp"

#include <map>
#include <string>

namespace surefoot::simulation {

/// Does a limit count, given its flag and its range?
[[nodiscard]] bool is_limited(const mjSpec& spec, mjtLimited flag, const double* range);

/// Torque limits of joints in a spec, by name [N·m]: what actuators may exert (`forcerange`, and
/// `ctrlrange` of a motor, times `gear`), and no more than `actuatorfrcrange` of the joint. Joints
/// without a limit are left out.
[[nodiscard]] std::map<std::string, double> effort_limits(const mjSpec& spec);

}  // namespace surefoot::simulation
