#include "surefoot/tasks/posture.hpp"

#include <algorithm>

namespace surefoot::tasks {

void Posture::find_parts(const model::RobotDescription& robot) {
  joints_ = ChosenJoints(name(), options_.joints, robot);
}

void Posture::write(const TaskInput& input, solver::Level& level) const noexcept {
  joints_.for_each(input.plan.arm.arm, [&](int joint) { write(input, joint, level); });
}

void Posture::write(const TaskInput& input, int joint, solver::Level& level) const {
  const JointVector& plan = input.plan.joints;
  const JointVector& nominal = input.robot.q_nominal;
  const bool is_planned = options_.target == Target::plan;
  double target = nominal[joint];
  if (is_planned) target = plan.size() > joint ? plan[joint] : input.dynamics.q[joint];
  const double error =
      std::clamp(target - input.dynamics.q[joint], -options_.max_error, options_.max_error);
  solver::Rows rows = level.add(1, first_id() + joint);
  rows.A(0, 6 + joint) = 1.0;
  rows.set_equal(0, options_.kp * error - options_.kd * input.dynamics.u[6 + joint]);
}

}  // namespace surefoot::tasks
