#include "surefoot/tasks/frame_position.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {

void FramePosition::write(const TaskInput& input, solver::Level& level) const noexcept {
  const std::optional<Motion> followed = motion(input);
  if (!followed) return;
  const auto& [now, plan] = *followed;
  const model::PointKinematics& point = now.point;
  const Vec3 error = clip_norm<3>(plan.p_XF - point.p, options_.max_error);
  solver::Rows rows = level.add(3, first_id());
  rows.A.leftCols(input.dynamics.num_velocities()) = point.J;
  rows.lower = plan.a_XF + options_.kd * (plan.v_XF - point.v) + options_.kp * error - point.Jdot_u;
  rows.upper = rows.lower;
}

}  // namespace surefoot::tasks
