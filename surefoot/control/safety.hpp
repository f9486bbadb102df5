#pragma once

#include "surefoot/control/safety_options.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/solver/solution.hpp"

namespace surefoot {

/// The last stage of a tick: whatever came before, the command is finite and inside the torque
/// limits.
///
/// Ladder:
///
///     optimal
///     degraded   the solver ended early, but after the levels that keep the physics
///     hold       joint PD about the last good posture, on top of the last good torques; about the
///                first posture that was seen, if there never was a good tick
///     damping    τ = −k_d q̇, latched: after repeated failures, non-finite readings that last, or
///                a torso tilted too far
class Safety {
 public:
  /// `first_free_level`: a solve that ended at or after this level is still usable.
  Safety(const SafetyOptions& options, const RobotDescription& robot, int first_free_level);

  /// `state` may hold NaN; `solution` is null where the tick could not come to solve.
  [[nodiscard]] const JointCommand& command(const RobotState& state,
                                            const Solution* solution) noexcept;

 private:
  void hold(const RobotState& state);
  void damp(const RobotState& state);
  void limit();

  SafetyOptions options_;
  JointVector torque_limit_;
  double hold_kp_, hold_kd_, damping_kd_;
  int first_free_level_;
  int failures_ = 0;
  bool damping_ = false;
  JointVector good_q_ = JointVector::Constant(kNaN);
  JointVector good_torque_ = JointVector::Zero();
  JointCommand command_;
};

}  // namespace surefoot
