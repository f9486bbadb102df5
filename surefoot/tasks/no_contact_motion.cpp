#include "surefoot/tasks/no_contact_motion.hpp"

namespace surefoot::tasks {

void NoContactMotion::write(const TaskInput& input, solver::Level& level) const noexcept {
  for (const Leg leg : input.plan.feet.legs()) {
    if (!input.plan.contact(leg)) continue;
    const model::PointKinematics& contact = input.dynamics.contact[index(leg)];
    solver::Rows rows = level.add(3, first_id() + 3 * static_cast<int>(leg));
    rows.A.leftCols(input.dynamics.num_velocities()) = contact.J;
    rows.lower = -contact.Jdot_u - options_.kd * contact.v;
    rows.upper = rows.lower;
  }
}

}  // namespace surefoot::tasks
