#pragma once

#include "surefoot/gaits/parts/pose_filter.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot::gaits {

/// Reference of an arm's tip from the operator's command, in the command's frame X (B or W), by a
/// `PoseFilter` with the position r. In W, with p_WX, v_WX and w_WX of the frame,
///
///     p_WT = p_WX + R_WX r,   v_WT = v_WX + w_WX × R_WX r + R_WX ṙ,   a_WT = R_WX r̈
///
/// which leaves out the base's acceleration.
class ArmReference {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  ArmReference(double period, const Scale& scale);

  /// One tick. Does not allocate.
  [[nodiscard]] ArmPlan update(const ReachCommand& command, const RobotState& state,
                               const model::Dynamics& dynamics) noexcept;

 private:
  void begin(const ReachCommand& command, const RobotState& state,
             const model::FrameKinematics& tip);

  ReachCommand command_;
  PoseFilter pose_;  // in X
};

}  // namespace surefoot::gaits
