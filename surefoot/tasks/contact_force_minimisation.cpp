#include "surefoot/tasks/contact_force_minimisation.hpp"

namespace surefoot::tasks {

void ContactForceMinimisation::write(const TaskInput& input, solver::Level& level) const noexcept {
  const Mat3 weighted_axes = weights_.asDiagonal() * input.plan.R_WC.transpose();
  for (const Leg leg : input.plan.feet.legs()) {
    if (!input.support.in_contact(leg)) continue;
    const int force = input.support.first_force(leg);
    solver::Rows rows = level.add(3, first_id() + 3 * static_cast<int>(leg));
    rows.A.noalias() = weighted_axes * input.support.Lambda().middleRows<3>(force);
    rows.lower.noalias() = -weighted_axes * input.support.lambda_0().segment<3>(force);
    rows.upper = rows.lower;
  }
}

}  // namespace surefoot::tasks
