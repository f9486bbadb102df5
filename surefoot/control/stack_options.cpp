#include "surefoot/control/stack_options.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/tasks/catalog.hpp"
#include "surefoot/tasks/chosen_joints.hpp"
#include "surefoot/tasks/joint_position_limits.hpp"
#include "surefoot/tasks/posture.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace surefoot::control {
namespace {

constexpr std::array<std::string_view, 4> kPhysics{"equations_of_motion", "no_contact_motion",
                                                   "torque_limits", "friction_cone"};

constexpr std::array<std::string_view, 2> kEfforts{"contact_force_minimisation",
                                                   "torque_minimisation"};

// Of further joints, as of swing feet, at scale 1: a toe turns so little that steps of the drives
// would move it.
constexpr double kHeldGain = 800.0;    // [1/s²]
constexpr double kHeldDamping = 56.0;  // [1/s]

// Of the damping of an arm that reaches, beside its tip: of rad/s² against m/s² [m].
constexpr double kSlowingWeight = 0.1;

constexpr const char* kStops = "joint_position_limits";

LevelSpec level_of(const char* name, std::initializer_list<const char*> tasks) {
  LevelSpec made{.name = name, .tasks = {}};
  for (const char* task : tasks) made.tasks.emplace_back().task = task;
  return made;
}

bool has(const LevelSpec& level, std::string_view task) {
  return std::ranges::find(level.tasks, task, &TaskSpec::task) != level.tasks.end();
}

bool is_physical(const TaskSpec& task) {
  return std::ranges::find(kPhysics, task.task) != kPhysics.end();
}

bool is_of_frame(const TaskSpec& task) {
  return task.task == "frame_position" || task.task == "frame_orientation";
}

/// Empty where none is given.
std::string choice(const TaskSpec& task, const char* name) {
  const auto given = task.choices.find(name);
  return given == task.choices.end() ? std::string() : given->second;
}

/// Which joints a task of joints is for.
struct JointKinds {
  bool arms = false, legs = false, further = false;  // of legs: HAA, HFE, KFE; the further ones
};

JointKinds kinds_of(const TaskSpec& task, const model::RobotDescription& robot) {
  const auto given = task.choices.find("joints");
  const std::string own = task.task == kStops ? tasks::JointPositionLimits::Options{}.joints
                                              : tasks::Posture::Options{}.joints;
  const tasks::ChosenJoints joints(task.task, given == task.choices.end() ? own : given->second,
                                   robot);
  const int first_further = robot.further_joints(Leg{0}).first;
  JointKinds kinds;
  for (const auto& [joint, arm] : joints.all()) {
    bool& kind = arm >= 0 ? kinds.arms : joint < first_further ? kinds.legs : kinds.further;
    kind = true;
  }
  return kinds;
}

/// Does it keep joints in their ranges, and not those of arms alone?
bool bounds_legs(const TaskSpec& task, const model::RobotDescription& robot) {
  return task.task == kStops && kinds_of(task, robot).legs;
}

/// Is it a posture of a further joint of a leg?
bool moves_further(const TaskSpec& task, const model::RobotDescription& robot) {
  return task.task == "posture" && kinds_of(task, robot).further;
}

/// How a stack's tasks treat the robot's arms.
struct ArmTasks {
  bool move_arms = false;        ///< by the reaching tip or a posture
  std::string followed, others;  ///< joints of arms with a frame that a task follows, and of others
  std::string last;              ///< level with such a task
};

ArmTasks arm_tasks(const StackOptions& stack, const model::RobotDescription& robot) {
  ArmTasks found;
  std::vector<bool> follows(robot.arms.size(), false);
  const auto note = [&](const LevelSpec& level, const TaskSpec& task) {
    const bool is_frame = is_of_frame(task);
    const std::string frame = choice(task, "frame");
    if (is_frame && frame.empty()) found.move_arms = true;
    if (task.task == "posture" && kinds_of(task, robot).arms) found.move_arms = true;
    if (!is_frame || frame.empty()) return;
    const model::Frames frames(robot);
    const int arm = frames.arm_of(frames.number(frame));
    if (arm < 0) return;
    follows[static_cast<std::size_t>(arm)] = true;
    found.last = level.name;
  };
  for (const LevelSpec& level : stack.levels) {
    for (const TaskSpec& task : level.tasks) note(level, task);
  }
  for (std::size_t arm = 0; arm < follows.size(); ++arm) {
    std::string& joints = follows[arm] ? found.followed : found.others;
    for (const std::string& name : robot.arms[arm].joints)
      joints += (joints.empty() ? "" : " ") + name;
  }
  return found;
}

void insert_below_physics(LevelSpec level, StackOptions& stack) {
  const auto last = std::find_if(stack.levels.rbegin(), stack.levels.rend(),
                                 [](const LevelSpec& one) { return keeps_physics(one); });
  stack.levels.insert(last.base(), std::move(level));
}

/// The tip of the arm that reaches, with slow joints.
LevelSpec tip_level(const Scale& scale) {
  LevelSpec level = level_of("arm_tip", {"frame_position", "frame_orientation", "joint_damping"});
  TaskSpec& slow = level.tasks.back();
  slow.choices["joints"] = "reaching_arm";
  slow.weight = scale.length * kSlowingWeight;
  return level;
}

/// Does a thigh of the standing robot nearly meet its stop?
bool has_thighs_at_stops(const model::RobotDescription& robot) {
  constexpr double kNear = 0.9;  // about twice what half a stride turns it [rad]
  return robot.can_walk() && std::ranges::any_of(robot.legs.legs(), [&](Leg leg) {
           const Eigen::Index hfe = first_joint(leg) + 1;
           const double q = robot.q_nominal[hfe];
           return std::min(q - robot.q_min[hfe], robot.q_max[hfe] - q) < kNear;
         });
}

}  // namespace

bool keeps_physics(const LevelSpec& level) { return std::ranges::any_of(level.tasks, is_physical); }

void check_physics(const StackOptions& stack) {
  const std::string_view motion = kPhysics.front();
  const auto refuse = [&](const std::string& what) {
    throw Error("the stack \"" + stack.name + "\" has " + what +
                ": its torques would not move the robot as its tasks ask; valid is a stack that "
                "begins with equations_of_motion, no_contact_motion, torque_limits and "
                "friction_cone");
  };
  const auto first = std::ranges::find_if(
      stack.levels, [&](const LevelSpec& level) { return has(level, motion); });
  if (first == stack.levels.end()) refuse("no equations_of_motion");
  for (auto level = stack.levels.begin(); level <= first; ++level) {
    const auto other = std::ranges::find_if_not(level->tasks, is_physical);
    if (other == level->tasks.end()) continue;
    refuse(other->task + (level == first ? " beside" : " above") + " equations_of_motion");
  }
}

std::vector<std::string> missing_physics(const StackOptions& stack) {
  constexpr std::array<const char*, 3> kConsequences{
      "feet that carry the robot slip away, and it falls",
      "torques beyond the joints' limits are cut off, which no task knows",
      "feet pull on the ground and slide, and are not unloaded before they lift off"};
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < kConsequences.size(); ++i) {
    const std::string_view task = kPhysics[i + 1];
    const bool is_there =
        std::ranges::any_of(stack.levels, [&](const LevelSpec& level) { return has(level, task); });
    if (!is_there)
      missing.push_back("the stack \"" + stack.name + "\" has no " + std::string(task) + ": " +
                        kConsequences[i]);
  }
  return missing;
}

StackOptions with_arms(StackOptions stack, const model::RobotDescription& robot) {
  const ArmTasks found = arm_tasks(stack, robot);
  if (found.move_arms || robot.arms.empty()) return stack;
  const auto saves = [](const TaskSpec& task) {
    return std::ranges::find(kEfforts, task.task) != kEfforts.end();
  };
  const auto effort = std::ranges::find_if(
      stack.levels, [&](const LevelSpec& one) { return std::ranges::all_of(one.tasks, saves); });
  LevelSpec rest = level_of("arm_rest", {"posture"}), idle = level_of("arm_posture", {"posture"});
  if (found.followed.empty()) {
    LevelSpec limits = level_of("arm_limits", {kStops});
    limits.tasks.front().choices["joints"] = "reaching_arm";
    rest.tasks.front().choices["joints"] = "reaching_arm";
    idle.tasks.front().choices["joints"] = "idle_arms";
    stack.levels.insert(effort, {limits, tip_level(robot.scale), rest});
  } else {
    rest.tasks.front().choices["joints"] = found.followed;
    idle.tasks.front().choices["joints"] = found.others;
    const auto last = std::ranges::find(stack.levels, found.last, &LevelSpec::name);
    stack.levels.insert(last + 1, rest);
  }
  if (!found.followed.empty() && found.others.empty()) return stack;
  insert_below_physics(std::move(idle), stack);
  return stack;
}

bool follows_tip(const StackOptions& stack) {
  const std::vector<std::string> ours = tasks::task_names();
  const auto may_follow = [&](const TaskSpec& task) {
    const bool is_own = std::ranges::find(ours, task.task) == ours.end();
    return is_own || (is_of_frame(task) && choice(task, "frame").empty());
  };
  return std::ranges::any_of(stack.levels, [&](const LevelSpec& level) {
    return std::ranges::any_of(level.tasks, may_follow);
  });
}

StackOptions with_further_joints(StackOptions stack, const model::RobotDescription& robot) {
  const bool moves = std::ranges::any_of(stack.levels, [&](const LevelSpec& level) {
    return std::ranges::any_of(level.tasks,
                               [&](const TaskSpec& task) { return moves_further(task, robot); });
  });
  const auto has_further = [](const model::LegDescription& leg) { return !leg.further.empty(); };
  if (moves || std::ranges::none_of(robot.legs, has_further)) return stack;
  LevelSpec held = level_of("leg_posture", {"posture"});
  TaskSpec& posture = held.tasks.front();
  posture.choices["joints"] = "further";
  posture.numbers["kp"] = kHeldGain / robot.scale.length;
  posture.numbers["kd"] = robot.scale.rate() * kHeldDamping;
  insert_below_physics(std::move(held), stack);
  return stack;
}

StackOptions with_stops(StackOptions stack, const model::RobotDescription& robot) {
  if (!has_thighs_at_stops(robot)) return stack;
  const auto level_with = [&](const char* task) {
    return std::ranges::find_if(stack.levels,
                                [&](const LevelSpec& level) { return has(level, task); });
  };
  const auto swing = level_with("swing_foot");
  const bool reaches = level_with("limb_extension_limits") != stack.levels.end();
  const bool has_stops = std::ranges::any_of(stack.levels, [&](const LevelSpec& level) {
    return std::ranges::any_of(level.tasks,
                               [&](const TaskSpec& task) { return bounds_legs(task, robot); });
  });
  if (!reaches || swing == stack.levels.end() || has_stops) return stack;
  if (std::any_of(swing, stack.levels.end(), keeps_physics)) return stack;
  LevelSpec stops{.name = kStops, .tasks = {}};
  stops.tasks.emplace_back().task = kStops;
  stack.levels.insert(swing, stops);
  return stack;
}

StackOptions weighted_from(StackOptions stack, std::size_t first) {
  if (first >= stack.levels.size()) return stack;
  const auto physics = std::find_if(stack.levels.rbegin(), stack.levels.rend(), keeps_physics);
  if (stack.levels.rend() - physics > static_cast<std::ptrdiff_t>(first)) {
    throw Error("the level \"" + physics->name +
                "\" keeps the physics and can't be weighted; valid is a level after it");
  }
  LevelSpec weighted{.name = "weighted", .tasks = {}};
  for (std::size_t k = first; k < stack.levels.size(); ++k) {
    for (TaskSpec& task : stack.levels[k].tasks) weighted.tasks.push_back(std::move(task));
  }
  stack.levels.resize(first);
  stack.levels.push_back(std::move(weighted));
  return stack;
}

}  // namespace surefoot::control
