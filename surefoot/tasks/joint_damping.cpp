#include "surefoot/tasks/joint_damping.hpp"

namespace surefoot::tasks {

void JointDamping::find_parts(const model::RobotDescription& robot) {
  joints_ = ChosenJoints(name(), options_.joints, robot);
}

void JointDamping::write(const TaskInput& input, solver::Level& level) const noexcept {
  joints_.for_each(input.plan.arm.arm, [&](int joint) {
    solver::Rows rows = level.add(1, first_id() + joint);
    rows.A(0, 6 + joint) = 1.0;
    rows.set_equal(0, -options_.kd * input.dynamics.u[6 + joint]);
  });
}

}  // namespace surefoot::tasks
