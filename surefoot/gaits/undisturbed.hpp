#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// Is a calibration undisturbed: all feet planned to stand, no slip, no horizontal push? A vertical
/// force may be a payload, which the calibration measures.
[[nodiscard]] bool is_undisturbed(const MotionPlan& plan, const RobotState& state);

}  // namespace surefoot::gaits
