#pragma once

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

/// A stack file come alive: the tasks of every level, and the hierarchy that they write at each
/// tick.
class TaskStack {
 public:
  /// Throws Error on a task or parameter that does not exist; the message lists what does.
  TaskStack(const StackOptions& options, const model::RobotDescription& robot);

  /// Levels that have rows from the next update on; all, before the first call. Those that keep the
  /// physics must be among them. Allocates nothing.
  void set_present(const solver::LevelSet& present) noexcept;

  /// This tick's rows. Allocates nothing.
  const solver::Hierarchy& update(const model::Dynamics& dynamics, const MotionPlan& plan) noexcept;

  /// Everything that the equations of motion and the contacts allow, of the last update and the
  /// same dynamics. Null where the contacts are singular, and for a stack that does not begin with
  /// these two tasks, each alone in its level, in this order. Allocates nothing.
  [[nodiscard]] const solver::Substitution* substitution(const model::Dynamics& dynamics) noexcept;

  /// Residual of the torso's roll and pitch in a solution of the last update [rad/s²]: NaN where it
  /// was not solved, 0 where the stack has no level of that task alone, without weight and damping.
  [[nodiscard]] double tilt_shortfall(const solver::Solution& solution) const noexcept;

  /// Unit, in W: of the friction pyramids, with several of them the last one's; NaN without any.
  [[nodiscard]] PerLeg<Vec3> pyramid_normals(const MotionPlan& plan) const noexcept;

  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return hierarchy_; }
  /// Contact forces as an affine function of x, of the last update.
  [[nodiscard]] const model::SupportDynamics& support() const { return support_; }
  /// Index of the level after the last one that has a task that keeps the physics: equations of
  /// motion, contacts, torque and contact force limits. The number of levels if that is the last.
  [[nodiscard]] int first_free_level() const { return first_free_level_; }
  [[nodiscard]] std::string row_name(int level, int id) const;
  /// All of them, by level and id.
  [[nodiscard]] std::vector<std::vector<std::string>> row_names() const;
  /// Of the rows of each level, "m/s² and rad/s²" where they have several; empty where they have
  /// weights.
  [[nodiscard]] std::vector<std::string> units() const;

 private:
  struct LevelTasks {
    std::vector<std::unique_ptr<tasks::Task>> tasks;
    std::vector<double> weights;  // by task
    double damping = 0.0;
    int num_ids = 0;  // of the tasks; those of damping follow
    bool is_present = true;
  };

  [[nodiscard]] bool is_only(std::size_t level, std::string_view task) const;
  /// Of the task alone; the number of levels if there is none.
  [[nodiscard]] std::size_t level_of(std::string_view task) const;
  void write(const LevelTasks& tasks, const tasks::TaskInput& input,
             solver::Level& level) const noexcept;

  model::RobotDescription robot_;
  std::vector<LevelTasks> levels_;
  model::SupportDynamics support_;
  solver::Hierarchy hierarchy_;
  tasks::PhysicsSubstitution physics_;
  int first_free_level_ = 0;
  std::size_t torso_tilt_ = 0;                          // its level
  const tasks::FrictionCone* friction_cone_ = nullptr;  // of `levels_`
  Eigen::VectorXd no_motion_;                           // the zeros that damping pulls to
};

}  // namespace surefoot::control
