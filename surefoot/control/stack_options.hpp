#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/tasks/task_definition.hpp"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace surefoot::control {

/// One task of a stack file: its name in the catalog or of the user's own tasks, and its parameters
/// as written.
struct TaskSpec {
  std::string task;
  std::map<std::string, double> numbers = {};       ///< e.g. kp: 500
  std::map<std::string, std::string> choices = {};  ///< e.g. form: radial
  double weight = 1.0;  ///< of its rows within the level; residuals include it
};

/// One priority level; usually one task.
struct LevelSpec {
  std::string name;
  std::vector<TaskSpec> tasks;
  double damping = 0.0;  ///< see `add_damping`, towards x = 0; 0 is none
};

/// A hierarchy as data, read from stacks/*.yaml; highest priority first.
struct StackOptions {
  std::string name;
  std::vector<LevelSpec> levels;
  tasks::OwnTasks own_tasks = {};  ///< the user's, that levels can name
};

/// Does the level have a task that makes the torques physical: equations of motion, contacts,
/// torque or contact force limits?
[[nodiscard]] bool keeps_physics(const LevelSpec& level);

/// Throws Error unless equations of motion are in the stack, and above them or beside them only
/// tasks that keep the physics: accelerations that the dynamics don't allow would have precedence.
void check_physics(const StackOptions& stack);
/// What else the stack lacks of the physics, with the consequence; a sentence each.
[[nodiscard]] std::vector<std::string> missing_physics(const StackOptions& stack);

/// The stack of a robot with arms, unless its tasks move arms already. Below the levels that keep
/// the physics, `arm_posture` holds the arms that do not reach: lower down they would be thrown
/// about to save the torso's pose. Before the levels that only save effort, `arm_limits`, `arm_tip`
/// and `arm_rest` move the one that reaches, as far as balance and torso leave it, with slow
/// joints: in `arm_tip` `joint_damping` shares the tip's level. Arms of which a task follows a
/// frame have `arm_rest` right below it. Throws UnknownNameError for an unknown frame.
[[nodiscard]] StackOptions with_arms(StackOptions stack, const model::RobotDescription& robot);
/// Does a task follow the tip of the arm that reaches? One of the user's own may.
[[nodiscard]] bool follows_tip(const StackOptions& stack);

/// The stack of a robot whose legs have further joints, unless a posture of it is for them: below
/// the levels that keep the physics, `leg_posture` holds them.
[[nodiscard]] StackOptions with_further_joints(StackOptions stack,
                                               const model::RobotDescription& robot);

/// The stack of a robot whose thighs stand near their stops: where legs reach down as far as
/// `limb_extension_limits` allows, `joint_position_limits` comes before the level of the swing
/// feet. At a stop the drive pushes against it, which would be taken for a force of the ground. The
/// same stack if it has the task already.
[[nodiscard]] StackOptions with_stops(StackOptions stack, const model::RobotDescription& robot);

/// Merges all levels from `first` on into one last level, "weighted", in which the tasks' weights
/// replace their order. Omits the damping of these levels. Throws Error if one of them keeps the
/// physics, which must not be traded for a task.
[[nodiscard]] StackOptions weighted_from(StackOptions stack, std::size_t first);

}  // namespace surefoot::control
