#pragma once

#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// Joint angles of a folded robot: each foot below its hip by `height` [m], knees on the side of
/// the nominal posture. Where a leg can't fold so far, as far as it comes.
[[nodiscard]] JointVector lying_posture(const model::RobotModel& model, double height);

}  // namespace surefoot::control
