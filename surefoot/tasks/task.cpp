#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

void Task::prepare(const model::RobotDescription& robot) {
  num_legs_ = robot.num_legs();
  arms_.clear();
  for (int j = robot.num_leg_joints(); j < robot.num_joints(); ++j)
    arms_.push_back(robot.joint_name(j));
}

std::string Task::joint_name(int id) const {
  const int arm_joint = id - kJointsPerLeg * num_legs_;
  if (arm_joint >= 0) return arms_[static_cast<std::size_t>(arm_joint)];
  return leg_joint_name(id, num_legs_);
}

std::string Task::leg_name(int leg) const {
  return std::string(surefoot::leg_name(static_cast<Leg>(leg), num_legs_));
}

std::string Task::leg_axis_name(int id) const { return leg_name(id / 3) + " " + "xyz"[id % 3]; }

}  // namespace surefoot::tasks
