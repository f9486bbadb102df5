#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Changes thigh and shank lengths in the spec without the controller's knowledge.
///
/// A length is the distance from a link's joint axis to the next axis, or to the centre of the foot
/// sphere. Bodies behind the longest fixed offset on the way move along that distance; masses and
/// the link's own shapes stay.
void change_link_lengths(mjSpec& spec, const model::RobotDescription& description,
                         const DisturbanceOptions& options);

}  // namespace surefoot::simulation
