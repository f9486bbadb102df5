#include "surefoot/tasks/com_xy.hpp"

#include "surefoot/math/rotation.hpp"

namespace surefoot::tasks {
namespace {

/// From the first to the second of two feet in contact, in the horizontal plane.
Vec2 support_line(const TaskInput& input) {
  Vec2 direction = Vec2::Zero();
  double sign = -1.0;
  for (const Leg leg : input.plan.feet.legs()) {
    if (!input.plan.contact(leg)) continue;
    direction += sign * input.dynamics.contact[index(leg)].p.head<2>();
    sign = 1.0;
  }
  return direction.normalized();
}

}  // namespace

void ComXy::write(const TaskInput& input, solver::Level& level) const noexcept {
  const int num_contacts = input.plan.num_contacts();
  if (num_contacts >= 3 || (input.dynamics.has_flat_feet() && num_contacts > 0)) {
    const Mat3 heading = rotation_about_z(yaw(input.plan.R_WC));
    write_row(input, heading.col(0).head<2>(), 0, level);
    write_row(input, heading.col(1).head<2>(), 1, level);
  } else if (num_contacts == 2) {
    write_row(input, support_line(input), 2, level);
  }
}

void ComXy::write_row(const TaskInput& input, const Vec2& direction, int id,
                      solver::Level& level) const noexcept {
  const model::PointKinematics& com = input.dynamics.com;
  const ComPlan& reference = input.plan.com;
  const Vec2 position_error = clip_norm<2>(reference.p - com.p.head<2>(), options_.max_error);
  const Vec2 velocity_error = reference.v - com.v.head<2>();
  const Vec2 acceleration = reference.a + options_.kd * velocity_error +
                            options_.kp * position_error - com.Jdot_u.head<2>();
  solver::Rows row = level.add(1, first_id() + id);
  row.A.leftCols(input.dynamics.num_velocities()).noalias() =
      direction.transpose() * com.J.topRows<2>();
  row.set_equal(0, direction.dot(acceleration));
}

std::string ComXy::row_name(int id) const {
  constexpr std::array<const char*, 3> kNames{"forward", "lateral", "along the support line"};
  return kNames[static_cast<std::size_t>(id)];
}

}  // namespace surefoot::tasks
