#include "surefoot/tasks/frame_orientation.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/reaching_tip.hpp"

namespace surefoot::tasks {

void FrameOrientation::write(const TaskInput& input, solver::Level& level) const noexcept {
  const model::FrameKinematics* frame = reaching_tip(input);
  if (frame == nullptr) return;
  const model::RotationKinematics& tip = frame->rotation;
  const ArmPlan& plan = input.plan.arm;
  const Vec3 error = clip_norm<3>(box_minus(plan.q_WT, Quat(tip.R)), options_.max_error);
  solver::Rows rows = level.add(3, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()) = tip.J;
  rows.lower = options_.kd * (plan.w_WT - tip.w) + options_.kp * error - tip.Jdot_u;
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
