#include "surefoot/tasks/frame_position.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {

void FramePosition::write(const TaskInput& input, solver::Level& level) const noexcept {
  const ArmPlan& plan = input.plan.arm;
  if (plan.arm < 0 || plan.arm >= static_cast<int>(input.dynamics.arm_tips.size())) return;
  const model::PointKinematics& tip =
      input.dynamics.arm_tips[static_cast<std::size_t>(plan.arm)].point;
  const Vec3 error = clip_norm<3>(plan.p_WT - tip.p, options_.max_error);
  solver::Rows rows = level.add(3, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()) = tip.J;
  rows.lower = plan.a_WT + options_.kd * (plan.v_WT - tip.v) + options_.kp * error - tip.Jdot_u;
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
