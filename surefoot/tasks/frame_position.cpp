#include "surefoot/tasks/frame_position.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/tasks/reaching_tip.hpp"

namespace surefoot::tasks {

void FramePosition::write(const TaskInput& input, solver::Level& level) const noexcept {
  const model::FrameKinematics* frame = reaching_tip(input);
  if (frame == nullptr) return;
  const model::PointKinematics& tip = frame->point;
  const ArmPlan& plan = input.plan.arm;
  const Vec3 error = clip_norm<3>(plan.p_WT - tip.p, options_.max_error);
  solver::Rows rows = level.add(3, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()) = tip.J;
  rows.lower = plan.a_WT + options_.kd * (plan.v_WT - tip.v) + options_.kp * error - tip.Jdot_u;
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
