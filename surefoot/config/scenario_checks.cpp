#include "surefoot/config/scenario_checks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/randomise.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/control/stack_reach.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/control/task_stack.hpp"
#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::config {
namespace {

/// Where a command asks for more than the robot has.
[[noreturn]] void refuse_reach(const ConfigNode& tree, double time, const std::string& what) {
  fail_at(*tree.find("user"), "user", formatted("at %g s, reach%s", time, what.c_str()));
}

/// A name stands for its place among the robot's frames; the stack must follow it.
int followed_frame(const ConfigNode& tree, const TimedCommand& command, const Scenario& scenario) {
  const model::Frames frames(scenario.robot);
  const control::TaskStack stack(scenario.controller.stack, scenario.robot);
  std::vector<std::string> followed;
  for (const model::FollowedFrame& frame : stack.followed_frames())
    followed.push_back(frames.names()[static_cast<std::size_t>(frame.number)]);
  if (std::ranges::find(followed, command.frame) != followed.end())
    return frames.number(command.frame);
  refuse_reach(tree, command.time,
               ".frame: no task of the stack follows \"" + command.frame + "\"; " +
                   valid_names(command.frame, followed));
}

/// The node for errors of the stance: its map, or the number that was drawn.
const ConfigNode& place_of_stance(const ConfigNode& tree) {
  const ConfigNode* planner = tree.find("planner");
  const ConfigNode* stance = planner == nullptr ? nullptr : planner->find("stance");
  if (stance == nullptr) return tree;
  const auto drawn = std::ranges::find_if(
      stance->members, [](const auto& member) { return member.second.where.ends_with(kDrawn); });
  return drawn == stance->members.end() ? *stance : drawn->second;
}

}  // namespace

void check_stack(const Section& top, const Scenario& scenario) {
  try {
    control::check_physics(scenario.controller.stack);
    (void)control::TaskStack(scenario.controller.stack, scenario.robot);
  } catch (const Error& error) {
    top.fail("stack", error.what());
  }
}

void find_reaches(const ConfigNode& tree, Scenario& scenario) {
  const auto num_arms = static_cast<int>(scenario.robot.arms.size());
  for (TimedCommand& command : scenario.commands) {
    ReachCommand& reach = command.user.reach;
    if (!command.frame.empty()) reach.frame = followed_frame(tree, command, scenario);
    if (reach.arm < num_arms) continue;
    refuse_reach(tree, command.time,
                 formatted(".arm: is %d, but the robot has %s", reach.arm,
                           num_arms == 0 ? "no arms"
                                         : ("arms 0 to " + std::to_string(num_arms - 1)).c_str()));
  }
  const ConfigNode* user = tree.find("user");
  if (user == nullptr) return;
  for (const ConfigNode& command : user->items) {
    const ConfigNode* reach = command.find("reach");
    if (reach == nullptr || reach->kind != ConfigNode::Kind::map) continue;
    if ((reach->find("arm") == nullptr) == (reach->find("frame") == nullptr))
      fail_at(*reach, "user", "reach: needs either the number of an arm, or a frame");
  }
}

void check_pushes(const ConfigNode& tree, const Scenario& scenario) {
  const ConfigNode* disturbances = tree.find("disturbances");
  const ConfigNode* pushes = disturbances == nullptr ? nullptr : disturbances->find("pushes");
  if (pushes == nullptr || pushes->members.empty()) return;
  std::vector<std::string> links;
  for (const model::UrdfLink& link : model::read_urdf(scenario.robot).links)
    links.push_back(link.name);
  for (const auto& [name, push] : pushes->members) {
    const ConfigNode* body = push.find("body");
    if (body == nullptr || std::ranges::find(links, body->text) != links.end()) continue;
    fail_at(*body, "disturbances.pushes." + name + ".body",
            "the robot has no link \"" + body->text + "\"; " + valid_names(body->text, links));
  }
}

void check_reach(const ConfigNode& tree, const model::RobotModel& model,
                 const control::StackOptions& stack) {
  try {
    control::check_reach(stack, control::reach_of(model));
  } catch (const control::BeyondReachError& error) {
    const ConfigNode* tasks = tree.find("tasks");
    const ConfigNode* task = tasks == nullptr ? nullptr : tasks->find(error.task());
    const ConfigNode* number = task == nullptr ? nullptr : task->find(error.number());
    const std::string message =
        std::string(error.what()) + (model.description().scale.length == 1.0
                                         ? ""
                                         : "; numbers for ANYmal B fit it with scaled: true in "
                                           "their file");
    if (number != nullptr) fail_at(*number, "tasks", message);
    const ConfigNode* named = tree.find("stack");
    fail_at(named == nullptr ? tree : *named, "stack", message);
  }
}

JointVector read_posture(const ConfigNode& tree, const model::RobotModel& model,
                         const gaits::StanceOptions& stance) {
  try {
    return stance_posture(model, stance);
  } catch (const Error& error) {
    fail_at(place_of_stance(tree), "", error.what());
  }
}

void check_calibration(const ConfigNode& tree, const Scenario& scenario) {
  const gaits::CalibrationOptions& o = scenario.controller.planner.calibration;
  const double least = gaits::CalibrationMotion::shortest_duration(o, scenario.robot.scale);
  if (!scenario.robot.can_walk() || o.duration == 0.0 || o.duration >= least) return;
  const ConfigNode* where = &tree;
  for (const char* key : {"planner", "calibration", "duration"}) {
    const ConfigNode* inside = where->find(key);
    if (inside == nullptr) break;
    where = inside;
  }
  fail_at(*where, "planner.calibration.duration",
          formatted("%g s is too short for a turn by these angles; expected at least %g s, or 0 "
                    "for none",
                    o.duration, std::ceil(100.0 * least) / 100.0));
}

void fit_to_standing(const ConfigNode& tree, Scenario& scenario) {
  if (scenario.robot.can_walk()) return;
  const std::string only = scenario.robot.name + " has flat feet and only stands";
  for (const TimedCommand& command : scenario.commands) {
    if (command.user.walk)
      fail_at(*tree.find("user"), "user",
              formatted("at %g s, walk: %s; valid is false, with height and shift", command.time,
                        only.c_str()));
    if (command.user.calibrate)
      fail_at(
          *tree.find("user"), "user",
          formatted("at %g s, calibrate: %s, and is not calibrated", command.time, only.c_str()));
  }
  if (scenario.plant.initial.is_given)
    fail_at(*tree.find("initial")->find("joints"), "initial.joints",
            only + "; it begins in the posture of its file");
  gaits::set_num_legs(scenario.controller.planner, scenario.robot.num_legs());
}

void complete_posture(const ConfigNode& tree, const model::RobotModel& model, Scenario& scenario) {
  simulation::InitialState& initial = scenario.plant.initial;
  const JointVector stance = read_posture(tree, model, scenario.controller.planner.stance);
  if (!initial.is_given) initial.q = stance;
  for (Eigen::Index i = 0; i < initial.q.size(); ++i) {
    double& q = initial.q[i];
    if (std::isnan(q)) q = stance[i];
    const model::RobotDescription& robot = scenario.robot;
    if (!initial.is_given || (q >= robot.q_min[i] && q <= robot.q_max[i])) continue;
    const ConfigNode& joints = *tree.find("initial")->find("joints");
    const auto leg = static_cast<std::size_t>(i / kJointsPerLeg);
    const auto joint = static_cast<std::size_t>(i % kJointsPerLeg);
    fail_at(joints, "initial.joints." + std::string(leg_names(robot.num_legs())[leg]),
            formatted("%s is %g rad; valid is %g to %g rad",
                      std::string(kJointNames[joint]).c_str(), q, robot.q_min[i], robot.q_max[i]));
  }
}

void check_strength(const ConfigNode& tree, model::RobotModel& model, const JointVector& stance,
                    std::vector<std::string>& notes) {
  const JointVector torque = control::standing_torque(model, stance).cwiseAbs();
  const model::RobotDescription& robot = model.description();
  Eigen::Index i = 0;
  if (torque.cwiseQuotient(robot.torque_limit).maxCoeff(&i) <= 1.0) {
    for (std::string& note : placeholder_notes(robot, torque)) notes.push_back(std::move(note));
    return;
  }
  const ConfigNode* named = tree.find("robot");
  fail_at(
      named == nullptr ? tree : *named, "robot",
      formatted("it can't stand: with %g kg, joint \"%s\" needs %.4g N·m in the stance, and its "
                "limits.torque is %g N·m; check this limit, and the masses in the URDF, in kg",
                model.mass(), robot.joint_names()[static_cast<std::size_t>(i)].c_str(), torque[i],
                robot.torque_limit[i]));
}

}  // namespace surefoot::config
