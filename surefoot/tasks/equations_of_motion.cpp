#include "surefoot/tasks/equations_of_motion.hpp"

namespace surefoot::tasks {

void EquationsOfMotion::write(const TaskInput& input, solver::Level& level) const noexcept {
  const auto Q_u = input.support.Q_u();
  solver::Rows rows = level.add(Q_u.cols(), first_id());
  const int num_joints = input.dynamics.num_joints();
  rows.A.leftCols(6 + num_joints) = -input.support.M_Q_u().transpose();
  rows.A.rightCols(num_joints) = Q_u.transpose().rightCols(num_joints);
  rows.lower.noalias() = Q_u.transpose() * input.dynamics.h;
  rows.upper = rows.lower;
}

std::string EquationsOfMotion::row_name(int id) const {
  return "direction " + std::to_string(id) + " of Q_u";
}

}  // namespace surefoot::tasks
