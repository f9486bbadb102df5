#include "surefoot/tasks/no_contact_motion.hpp"

namespace surefoot {

void NoContactMotion::write(const TaskInput& input, Level& level) const noexcept {
  for (const Leg leg : kLegs) {
    if (!input.plan.contact(leg)) continue;
    const PointKinematics& contact = input.dynamics.contact[index(leg)];
    Rows rows = level.add(3, first_id() + 3 * static_cast<int>(leg));
    rows.A.leftCols<kNumVelocities>() = contact.J;
    rows.lower = -contact.Jdot_u - options_.kd * contact.v;
    rows.upper = rows.lower;
  }
}

}  // namespace surefoot
