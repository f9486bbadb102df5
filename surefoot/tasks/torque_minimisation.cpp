#include "surefoot/tasks/torque_minimisation.hpp"

namespace surefoot::tasks {

void TorqueMinimisation::write(const TaskInput&, solver::Level& level) const noexcept {
  solver::Rows rows = level.add(kNumJoints, first_id());
  rows.A.rightCols<kNumJoints>().diagonal() = weights_.replicate<kNumLegs, 1>();
  rows.lower.setZero();
  rows.upper.setZero();
}

}  // namespace surefoot::tasks
