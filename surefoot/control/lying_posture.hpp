#pragma once

#include "surefoot/model/robot_model.hpp"

namespace surefoot::control {

/// Joint angles of a folded robot [rad]: each foot below its hip by `height` [m], or as close as
/// the leg can fold, with the knees on the side of the nominal posture. The nominal posture of a
/// robot that only stands.
[[nodiscard]] JointVector lying_posture(const model::RobotModel& model, double height);

}  // namespace surefoot::control
