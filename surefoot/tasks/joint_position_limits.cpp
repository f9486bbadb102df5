#include "surefoot/tasks/joint_position_limits.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>

namespace surefoot::tasks {

JointPositionLimits::JointPositionLimits(const Options& options)
    : options_(options), bound_(options.dt, options.response) {
  if (!(options.margin >= 0.0)) throw Error("joint_position_limits: margin must be at least 0");
}

void JointPositionLimits::find_parts(const model::RobotDescription& robot) {
  joints_ = ChosenJoints(name(), options_.joints, robot);
}

void JointPositionLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  joints_.for_each(input.plan.arm.arm, [&](int j) {
    // A range that is narrower than both margins shrinks to its middle.
    const double middle = 0.5 * (input.robot.q_min[j] + input.robot.q_max[j]);
    const double q_min = std::min(input.robot.q_min[j] + options_.margin, middle);
    const double q_max = std::max(input.robot.q_max[j] - options_.margin, middle);
    solver::Rows rows = level.add(1, first_id() + j);
    rows.A(0, 6 + j) = 1.0;
    bound_.write(rows, 0, q_min, q_max, input.dynamics.q[j], input.dynamics.u[6 + j], 0.0);
  });
}

}  // namespace surefoot::tasks
