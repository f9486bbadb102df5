#include "surefoot/tasks/swing_foot.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {

void SwingFoot::write(const TaskInput& input, solver::Level& level) const noexcept {
  for (const Leg leg : input.plan.feet.legs()) {
    if (input.plan.contact(leg)) continue;
    const model::PointKinematics& foot = input.dynamics.foot[index(leg)];
    const FootPlan& reference = input.plan.feet[index(leg)];
    const Vec3 position_error = clip_norm<3>(reference.p_WF - foot.p, options_.max_error);
    const Vec3 velocity_error = reference.v_WF - foot.v;
    solver::Rows rows = level.add(3, first_id() + 3 * static_cast<int>(leg));
    rows.A.leftCols(input.dynamics.num_velocities()) = foot.J;
    rows.lower =
        reference.a_WF + options_.kd * velocity_error + options_.kp * position_error - foot.Jdot_u;
    rows.upper = rows.lower;
  }
}

}  // namespace surefoot::tasks
