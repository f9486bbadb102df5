#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/model/description.hpp"

namespace surefoot::config {

/// Fits a scenario for ANYmal B to the joints of another robot. Knees of the stance that can't bend
/// to the side that is asked for point to one that they can. So does a leg of `initial.joints`: HAA
/// stays, HFE and KFE change their signs, and what lies beyond a limit moves to it. The ranges of
/// `randomise` for these joints go along.
void fit_joints(ConfigNode& scenario, const model::RobotDescription& robot);

}  // namespace surefoot::config
