#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/stack_fade.hpp"

#include <memory>

namespace surefoot::control {

/// The stack in use with its solver, and the transitions between sets of levels and between stacks.
/// Allocates only in its constructor and in `set_stack`.
class ActiveStack {
 public:
  ActiveStack(const ControllerOptions& options, const model::RobotDescription& robot);

  /// Writes this tick's rows. `time` is the plan's [s].
  const solver::Hierarchy& update(double time, const model::Dynamics& dynamics,
                                  const MotionPlan& plan) noexcept;
  /// Solves the rows of the last update. The reference stays valid until the next call.
  const solver::Solution& solve(double time, const model::Dynamics& dynamics,
                                const MotionPlan& plan) noexcept;
  /// Fills the report of that solution; with `explains` also the rows that block each level.
  void describe(const solver::Solution& solution, bool explains, HierarchyReport& report) noexcept;
  /// Feedback of that solution to the planner; during a transition the shortfall is unknown.
  [[nodiscard]] HierarchyOutcome outcome(const solver::Solution& solution,
                                         const MotionPlan& plan) const;

  /// Restarts, as the clock has changed.
  void restart() noexcept;
  /// As `Controller::switch_levels`.
  [[nodiscard]] bool switch_levels(const LevelSwitch& change);
  /// As `Controller::set_stack`.
  [[nodiscard]] bool set_stack(const StackOptions& options, double duration);

  /// What an own task did wrong in the last solution, of this stack or the one that fades out.
  [[nodiscard]] const PartFault& fault() const;
  [[nodiscard]] const TaskStack& tasks() const { return solved_->stack; }
  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return solved_->stack.hierarchy(); }

 private:
  [[nodiscard]] bool is_fading() const { return fade_ && fade_->is_going_on(); }
  [[nodiscard]] double share() const;

  SolverOptions solver_options_;
  model::RobotDescription robot_;
  std::unique_ptr<SolvedStack> solved_;
  std::unique_ptr<StackFade> fade_;  // from the previous stack, if any; kept after its end
  LevelSwitcher switcher_;
};

}  // namespace surefoot::control
