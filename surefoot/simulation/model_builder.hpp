#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

#include <string>
#include <vector>

namespace surefoot::simulation {

struct BuiltModel {
  ModelHandle model;
  std::string xml;  ///< MJCF text that `model` was compiled from
};

/// The physics model: the robot of the URDF with a free base, torque actuators named like their
/// joints in our order, all of its collision shapes, foot spheres; then the terrain. Masses are
/// disturbed as the options say. `notes` gets a line on each thing that was changed in the URDF's
/// model. Throws FileError if the URDF can't be read, Error if it does not fit the description.
[[nodiscard]] BuiltModel build_model(const RobotDescription& description,
                                     const PlantOptions& options, std::vector<std::string>& notes);

}  // namespace surefoot::simulation
