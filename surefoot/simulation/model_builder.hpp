#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

struct BuiltModel {
  ModelHandle model;
  std::string xml;  ///< MJCF text of `model`
};

/// The physics model: the URDF's robot with a free base, torque actuators with the joints' names in
/// our order, its collision shapes and foot spheres, the disturbed masses; then the terrain.
/// `notes` gets a line on each change to the URDF's model. Throws FileError if the URDF can't be
/// read, Error if it does not fit the description.
[[nodiscard]] BuiltModel build_model(const model::RobotDescription& description,
                                     const PlantOptions& options, std::vector<std::string>& notes);

}  // namespace surefoot::simulation
