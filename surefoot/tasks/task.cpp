#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

std::string leg_axis_name(int id) {
  return std::string(kLegNames[static_cast<std::size_t>(id / 3)]) + " " + "xyz"[id % 3];
}

void Task::prepare(const model::RobotDescription& robot) {
  arms_.clear();
  for (int j = kNumLegJoints; j < robot.num_joints(); ++j) arms_.push_back(robot.joint_name(j));
}

std::string Task::joint_name(int id) const {
  if (id >= kNumLegJoints) return arms_[static_cast<std::size_t>(id - kNumLegJoints)];
  return leg_joint_name(id);
}

}  // namespace surefoot::tasks
