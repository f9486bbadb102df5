#include "surefoot/tasks/joint_position_limits.hpp"

#include "surefoot/base/error.hpp"

namespace surefoot::tasks {

JointPositionLimits::JointPositionLimits(const Options& options)
    : options_(options), bound_(options.dt, options.response) {
  if (!(options.margin >= 0.0)) throw Error("joint_position_limits: margin must be at least 0");
}

void JointPositionLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  solver::Rows rows = level.add(input.dynamics.num_joints(), first_id());
  rows.A.middleCols(6, input.dynamics.num_joints()).setIdentity();
  for (int j = 0; j < input.dynamics.num_joints(); ++j) {
    // A range that is narrower than both margins shrinks to its middle.
    const double middle = 0.5 * (input.robot.q_min[j] + input.robot.q_max[j]);
    const double q_min = std::min(input.robot.q_min[j] + options_.margin, middle);
    const double q_max = std::max(input.robot.q_max[j] - options_.margin, middle);
    bound_.write(rows, j, q_min, q_max, input.dynamics.q[j], input.dynamics.u[6 + j], 0.0);
  }
}

}  // namespace surefoot::tasks
