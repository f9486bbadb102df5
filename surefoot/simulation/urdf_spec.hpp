#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// What physics needs of the robot's URDF as an editable MuJoCo spec: fixed links kept as bodies of
/// their own, the base free. Throws FileError or Error as build_model does.
[[nodiscard]] SpecHandle read_spec(const RobotDescription& description,
                                   std::vector<std::string>& notes);

/// The spec's bodies below and with `body`, in depth-first order.
[[nodiscard]] std::vector<mjsBody*> subtree(mjsBody& body);

/// A body by its name; throws UnknownNameError that names what the description calls it and what
/// exists.
[[nodiscard]] mjsBody& find_body(mjSpec& spec, const std::string& name, const std::string& role);

}  // namespace surefoot::simulation
