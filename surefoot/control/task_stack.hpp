#pragma once

#include "surefoot/control/part_fault.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/model/support_dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/soft_levels.hpp"
#include "surefoot/solver/solution.hpp"
#include "surefoot/tasks/friction_cone.hpp"
#include "surefoot/tasks/physics_substitution.hpp"
#include "surefoot/tasks/task.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::control {

/// The tasks of a stack, by level, and the hierarchy that they write at each tick.
class TaskStack {
 public:
  /// Throws Error on an unknown task or parameter; the message lists the valid ones.
  TaskStack(const StackOptions& options, const model::RobotDescription& robot);

  /// Sets the levels that have rows from the next update on; initially all. Must include those that
  /// keep the physics. Does not allocate.
  void set_present(const solver::LevelSet& present) noexcept;

  /// Writes this tick's rows. Does not allocate.
  const solver::Hierarchy& update(const model::Dynamics& dynamics, const MotionPlan& plan) noexcept;

  /// All x that satisfy equations of motion and contacts, for the last update and the same
  /// dynamics. Null if the contacts are singular, or if the stack does not begin with these two
  /// tasks, each alone in its level, in this order. Does not allocate.
  [[nodiscard]] const solver::Substitution* substitution(const model::Dynamics& dynamics) noexcept;

  /// Residual of the torso's roll and pitch in a solution of the last update [rad/s²]: NaN if not
  /// solved, 0 if no level has that task alone, without weight and damping.
  [[nodiscard]] double tilt_shortfall(const solver::Solution& solution) const noexcept;

  /// Unit axes of the friction pyramids in W, of the last such task; NaN without one.
  [[nodiscard]] PerLeg<Vec3> pyramid_normals(const MotionPlan& plan) const noexcept;

  /// What the first of the user's own tasks did wrong in the last update; its rows can't be solved.
  [[nodiscard]] const PartFault& fault() const { return fault_; }

  /// Frames that the tasks follow, each once.
  [[nodiscard]] const std::vector<model::FollowedFrame>& followed_frames() const {
    return followed_frames_;
  }
  /// Does a task follow the plan's joints?
  [[nodiscard]] bool follows_joints() const { return follows_joints_; }

  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return hierarchy_; }
  /// Contact forces as an affine function of x, of the last update.
  [[nodiscard]] const model::SupportDynamics& support() const { return support_; }
  /// Index after the last level that keeps the physics (`keeps_physics`).
  [[nodiscard]] int first_free_level() const { return first_free_level_; }
  [[nodiscard]] std::string row_name(int level, int id) const;
  /// All of them, by level and id.
  [[nodiscard]] std::vector<std::vector<std::string>> row_names() const;
  /// Unit of each level's rows, or units, as "m/s² and rad/s²"; empty for weighted rows.
  [[nodiscard]] std::vector<std::string> units() const;

 private:
  struct LevelTasks {
    std::vector<std::unique_ptr<tasks::Task>> tasks;
    std::vector<double> weights;  // by task
    bool has_own = false;         // tasks of the user
    double damping = 0.0;
    int num_ids = 0;  // of the tasks, followed by those of damping
    bool is_present = true;
  };

  [[nodiscard]] LevelTasks make_level(const LevelSpec& spec);
  [[nodiscard]] std::unique_ptr<tasks::Task> make_task(const TaskSpec& spec, LevelTasks& level);
  void note_followed(const tasks::Task& task);
  [[nodiscard]] bool is_only(std::size_t level, std::string_view task) const;
  /// Level of the task alone; the number of levels if there is none.
  [[nodiscard]] std::size_t level_of(std::string_view task) const;
  void write(const LevelTasks& tasks, const tasks::TaskInput& input, solver::Level& level) noexcept;
  void write_own(const LevelTasks& tasks, const tasks::TaskInput& input,
                 solver::Level& level) noexcept;

  model::RobotDescription robot_;
  tasks::OwnTasks own_tasks_;
  std::vector<LevelTasks> levels_;
  model::SupportDynamics support_;
  solver::Hierarchy hierarchy_;
  tasks::PhysicsSubstitution physics_;
  int first_free_level_ = 0;
  std::size_t torso_tilt_ = 0;                          // index of its level
  const tasks::FrictionCone* friction_cone_ = nullptr;  // of `levels_`
  std::vector<model::FollowedFrame> followed_frames_;
  bool follows_joints_ = false;
  Eigen::VectorXd no_motion_;  // zeros, the target of damping
  PartFault fault_;
};

}  // namespace surefoot::control
