#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

void Task::prepare(const model::RobotDescription& robot) {
  num_legs_ = robot.num_legs();
  num_leg_joints_ = robot.num_leg_joints();
  has_flat_feet_ = !robot.sole.isZero();
  joints_ = told_joints(robot.joint_names(), num_legs_);
  find_parts(robot);
}

std::string Task::joint_name(int id) const { return joints_[static_cast<std::size_t>(id)]; }

std::string Task::leg_name(int leg) const {
  return std::string(surefoot::leg_name(static_cast<Leg>(leg), num_legs_));
}

std::string Task::leg_axis_name(int id) const { return leg_name(id / 3) + " " + "xyz"[id % 3]; }

}  // namespace surefoot::tasks
