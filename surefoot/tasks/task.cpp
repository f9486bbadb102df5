#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

std::string leg_axis_name(int id) {
  return std::string(kLegNames[static_cast<std::size_t>(id / 3)]) + " " + "xyz"[id % 3];
}

std::string joint_name(int id) {
  return std::string(kLegNames[static_cast<std::size_t>(id / kJointsPerLeg)]) + "_" +
         std::string(kJointNames[static_cast<std::size_t>(id % kJointsPerLeg)]);
}

}  // namespace surefoot::tasks
