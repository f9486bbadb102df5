#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

/// The URDF as MuJoCo reads its joints and inertias by itself, with a free base; null if it can't.
[[nodiscard]] SpecHandle read_bare_spec(const model::RobotDescription& description);

/// The robot's physics URDF as an editable MuJoCo spec: fixed links as separate bodies, the base
/// free. Throws FileError or Error as build_model does.
[[nodiscard]] SpecHandle read_spec(const model::RobotDescription& description,
                                   std::vector<std::string>& notes);

/// `body` and the bodies below it, depth first.
[[nodiscard]] std::vector<mjsBody*> subtree(mjsBody& body);

/// A body by name; throws UnknownNameError with its role in the description and the existing names.
[[nodiscard]] mjsBody& find_body(mjSpec& spec, const std::string& name, const std::string& role);

}  // namespace surefoot::simulation
