#include "surefoot/tasks/torque_minimisation.hpp"

namespace surefoot::tasks {

void TorqueMinimisation::write(const TaskInput& input, solver::Level& level) const noexcept {
  solver::Rows rows = level.add(input.dynamics.num_joints(), first_id());
  auto weights = rows.A.rightCols(input.dynamics.num_joints()).diagonal();
  weights.setConstant(arms_);
  weights.head(num_leg_joints()).setOnes();
  if (!has_flat_feet()) weights.head(kJointsPerLeg * num_legs()) = legs_.replicate(num_legs(), 1);
  rows.lower.setZero();
  rows.upper.setZero();
}

}  // namespace surefoot::tasks
