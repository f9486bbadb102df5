#include "surefoot/tasks/chosen_joints.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/model/arm_of_joints.hpp"

#include <algorithm>
#include <sstream>

namespace surefoot::tasks {
namespace {

/// Of the names that joints have in messages and in the URDF.
int joint_of(std::string_view task, const model::RobotDescription& robot, const std::string& name) {
  std::vector<std::string> names = robot.joint_names();
  const auto num_joints = static_cast<int>(names.size());
  for (int j = 0; j < num_joints; ++j) names.push_back(robot.joint_name(j));
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<int>(found - names.begin()) % num_joints;
  throw UnknownNameError(std::string(task) + ": the robot " + robot.name + " has no joint \"" +
                         name + "\"; " + near_names(name, names));
}

}  // namespace

ChosenJoints::ChosenJoints(std::string_view task, const std::string& words,
                           const model::RobotDescription& robot)
    : when_(words == "reaching_arm" ? When::reaches
            : words == "idle_arms"  ? When::idle
                                    : When::always) {
  const std::vector<int> arm_of = model::arm_of_joints(robot);
  const bool of_legs = words == "legs" || words == "all";
  const bool of_arms = words == "all" || words == "arms" || when_ != When::always;
  const bool is_further = words == "further";
  if (of_legs || of_arms || is_further) {
    const int first_further = robot.further_joints(Leg{0}).first;
    for (int j = 0; j < robot.num_joints(); ++j) {
      const int arm = arm_of[static_cast<std::size_t>(j)];
      const bool is_chosen = arm >= 0 ? of_arms : of_legs || (is_further && j >= first_further);
      if (is_chosen) joints_.push_back({j, arm});
    }
    return;
  }
  std::istringstream names(words);
  for (std::string name; names >> name;) {
    const int j = joint_of(task, robot, name);
    const auto is_same = [j](const Joint& one) { return one.joint == j; };
    if (std::ranges::any_of(joints_, is_same))
      throw Error(std::string(task) + ": the joint \"" + name + "\" is named twice");
    joints_.push_back({j, arm_of[static_cast<std::size_t>(j)]});
  }
  if (joints_.empty())
    throw Error(std::string(task) +
                ": joints is empty; names, or arms, legs, further or all are valid");
}

}  // namespace surefoot::tasks
