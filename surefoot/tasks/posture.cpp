#include "surefoot/tasks/posture.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/model/arm_of_joints.hpp"

#include <algorithm>
#include <sstream>

namespace surefoot::tasks {
namespace {

/// Of the names that joints have in messages and in the URDF.
int joint_of(const model::RobotDescription& robot, const std::string& name) {
  std::vector<std::string> names = robot.joint_names();
  const auto num_joints = static_cast<int>(names.size());
  for (int j = 0; j < num_joints; ++j) names.push_back(robot.joint_name(j));
  const auto found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<int>(found - names.begin()) % num_joints;
  throw UnknownNameError("posture: the robot " + robot.name + " has no joint \"" + name + "\"; " +
                         near_names(name, names));
}

}  // namespace

void Posture::find_parts(const model::RobotDescription& robot) {
  const std::string& given = options_.joints;
  when_ = given == "reaching_arm" ? When::reaches
          : given == "idle_arms"  ? When::idle
                                  : When::always;
  joints_.clear();
  const std::vector<int> arm_of = model::arm_of_joints(robot);
  const bool of_legs = given == "legs" || given == "all";
  const bool of_arms = given == "all" || given == "arms" || when_ != When::always;
  const bool is_further = given == "further";
  if (of_legs || of_arms || is_further) {
    const int first_further = robot.further_joints(Leg{0}).first;
    for (int j = 0; j < robot.num_joints(); ++j) {
      const int arm = arm_of[static_cast<std::size_t>(j)];
      const bool is_chosen = arm >= 0 ? of_arms : of_legs || (is_further && j >= first_further);
      if (is_chosen) joints_.push_back({j, arm});
    }
    return;
  }
  std::istringstream names(given);
  for (std::string name; names >> name;) {
    const int j = joint_of(robot, name);
    const auto is_same = [j](const Joint& one) { return one.joint == j; };
    if (std::ranges::any_of(joints_, is_same))
      throw Error("posture: the joint \"" + name + "\" is named twice");
    joints_.push_back({j, arm_of[static_cast<std::size_t>(j)]});
  }
  if (joints_.empty())
    throw Error("posture: joints is empty; names, or arms, legs, further or all are valid");
}

void Posture::write(const TaskInput& input, solver::Level& level) const noexcept {
  for (const auto& [joint, arm] : joints_) {
    const bool reaches = input.plan.arm.arm == arm;
    if (when_ == When::always || reaches == (when_ == When::reaches)) write(input, joint, level);
  }
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
