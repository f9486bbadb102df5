#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Gives the robot in the spec thighs and shanks of other lengths than the controller's model has.
///
/// A length is the distance from a link's own joint axis to the next axis, or to the centre of the
/// foot sphere. What lies behind the longest fixed offset on the way is moved along that distance;
/// masses, and the shapes of the link itself, stay.
void change_link_lengths(mjSpec& spec, const RobotDescription& description,
                         const DisturbanceOptions& options);

}  // namespace surefoot::simulation
