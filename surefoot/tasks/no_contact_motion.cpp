#include "surefoot/tasks/no_contact_motion.hpp"

#include <array>

namespace surefoot::tasks {

void NoContactMotion::write(const TaskInput& input, solver::Level& level) const noexcept {
  for (const Leg leg : input.plan.feet.legs()) {
    if (!input.plan.contact(leg)) continue;
    const model::PointKinematics& contact = input.dynamics.contact[index(leg)];
    const int id = first_id() + rows_per_leg() * static_cast<int>(leg);
    solver::Rows rows = level.add(3, id);
    rows.A.leftCols(input.dynamics.num_velocities()) = contact.J;
    rows.lower = -contact.Jdot_u - options_.kd * contact.v;
    rows.upper = rows.lower;
    if (!has_flat_feet()) continue;
    const model::RotationKinematics& foot = input.dynamics.shank[index(leg)];
    solver::Rows turn = level.add(3, id + 3);
    turn.A.leftCols(input.dynamics.num_velocities()) = foot.J;
    turn.lower = -foot.Jdot_u - options_.kd * foot.w;
    turn.upper = turn.lower;
  }
}

std::string NoContactMotion::row_name(int id) const {
  if (!has_flat_feet()) return leg_axis_name(id);
  constexpr std::array<const char*, 6> kNames{" x", " y", " z", " about x", " about y", " about z"};
  return leg_name(id / 6) + kNames[static_cast<std::size_t>(id % 6)];
}

}  // namespace surefoot::tasks
