#include "surefoot/tasks/frame_orientation.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {

void FrameOrientation::write(const TaskInput& input, solver::Level& level) const noexcept {
  const std::optional<Motion> followed = motion(input);
  if (!followed) return;
  const auto& [now, plan] = *followed;
  const model::RotationKinematics& turn = now.rotation;
  const Vec3 error = clip_norm<3>(box_minus(plan.q_XF, Quat(turn.R)), options_.max_error);
  solver::Rows rows = level.add(3, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()) = turn.J;
  rows.lower = options_.kd * (plan.w_XF - turn.w) + options_.kp * error - turn.Jdot_u;
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
