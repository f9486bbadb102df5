#include "surefoot/config/joint_fitting.hpp"

#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/section.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace surefoot::config {
namespace {

void fit_knees(ConfigNode& knees, const model::RobotDescription& robot) {
  const auto wanted =
      std::ranges::find_if(kKnees, [&](const auto& one) { return one.first == knees.text; });
  if (wanted == kKnees.end()) return;
  const auto fitting = std::ranges::find(kKnees, knees_that_fit(robot, wanted->second),
                                         [](const auto& one) { return one.second; });
  knees.text = fitting->first;
}

/// Every number at and below a node, times a sign and within limits, in order.
void turn_and_clip(ConfigNode& node, double sign, double min, double max) {
  for (ConfigNode& item : node.items) turn_and_clip(item, sign, min, max);
  const std::optional<double> number = number_in(node.text);
  if (number) node.text = shortest_text(std::clamp(sign * *number, min, max));
  if (sign < 0.0) std::ranges::reverse(node.items);
}

/// By which ANYmal B's HFE and KFE are to be multiplied for a leg of this robot. `knee`: ANYmal
/// B's.
Vec3 signs_of(const model::RobotDescription& robot, Leg leg, double knee) {
  const Vec3 nominal = robot.q_nominal.head<3>();  // of a front leg; ANYmal B's: HFE > 0, KFE < 0
  Vec3 signs(1.0, std::copysign(1.0, nominal.y()), -std::copysign(1.0, nominal.z()));
  if (!can_bend(robot, leg, signs.z() * knee)) signs.tail<2>() *= -1.0;
  return signs;
}

/// A posture for four legs: middle ones are as the front ones.
void add_middle_legs(ConfigNode& scenario) {
  ConfigNode* initial = scenario.find("initial");
  ConfigNode* joints = initial == nullptr ? nullptr : initial->find("joints");
  if (joints == nullptr) return;
  for (const auto& [middle, front] : {std::pair{"LM", "LF"}, {"RM", "RF"}}) {
    const ConfigNode* given = joints->find(front);
    if (given == nullptr || joints->find(middle) != nullptr) continue;
    joints->members.emplace_back(middle, ConfigNode(*given));
  }
}

void fit_leg(ConfigNode& scenario, const model::RobotDescription& robot, Leg leg) {
  ConfigNode* initial = scenario.find("initial");
  ConfigNode* joints = initial == nullptr ? nullptr : initial->find("joints");
  const std::string name(leg_name(leg, robot.num_legs()));
  ConfigNode* given = joints == nullptr ? nullptr : joints->find(name);
  ConfigNode* ranges = scenario.find("randomise");
  if (given == nullptr) return;
  const ConfigNode* knee = given->find(std::string(kJointNames[2]));
  const std::optional<double> angle = knee == nullptr ? std::nullopt : number_in(knee->text);
  const Vec3 signs = signs_of(robot, leg, angle.value_or(is_front(leg) ? -1.0 : 1.0));
  for (Eigen::Index j = 0; j < kJointsPerLeg; ++j) {
    const std::string joint(kJointNames[static_cast<std::size_t>(j)]);
    ConfigNode* range =
        ranges == nullptr ? nullptr : ranges->find("initial.joints." + name + "." + joint);
    const Eigen::Index i = first_joint(leg) + j;
    for (ConfigNode* node : {given->find(joint), range}) {
      if (node != nullptr) turn_and_clip(*node, signs[j], robot.q_min[i], robot.q_max[i]);
    }
  }
}

}  // namespace

void fit_joints(ConfigNode& scenario, const model::RobotDescription& robot) {
  if (!robot.can_walk()) return;
  if (ConfigNode* planner = scenario.find("planner")) {
    ConfigNode* stance = planner->find("stance");
    ConfigNode* knees = stance == nullptr ? nullptr : stance->find("knees");
    if (knees != nullptr) fit_knees(*knees, robot);
  }
  if (robot.num_legs() == kMaxLegs) add_middle_legs(scenario);
  for (const Leg leg : robot.legs.legs()) fit_leg(scenario, robot, leg);
}

}  // namespace surefoot::config
