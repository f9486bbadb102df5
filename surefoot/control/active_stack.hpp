#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/stack_fade.hpp"

#include <memory>

namespace surefoot::control {

/// The stack that is in use, with its solver, and what leads from one set of levels or one stack to
/// another. Allocates in its constructor and in `set_stack` only.
class ActiveStack {
 public:
  ActiveStack(const ControllerOptions& options, const model::RobotDescription& robot);

  /// This tick's rows, by a clock that the plan has [s].
  const solver::Hierarchy& update(double time, const model::Dynamics& dynamics,
                                  const MotionPlan& plan) noexcept;
  /// Of the rows of the last update. The reference stays valid until the next call.
  const solver::Solution& solve(double time, const model::Dynamics& dynamics,
                                const MotionPlan& plan) noexcept;
  /// What is to be recorded of that solution; `explains`: what holds each level back, too.
  void describe(const solver::Solution& solution, bool explains, HierarchyReport& report) noexcept;
  /// What the planner is told of it. No shortfall is known between two optima.
  [[nodiscard]] HierarchyOutcome outcome(const solver::Solution& solution,
                                         const MotionPlan& plan) const;

  /// By another clock.
  void begin_anew() noexcept;
  /// As `Controller::switch_levels`.
  [[nodiscard]] bool switch_levels(const LevelSwitch& change);
  /// As `Controller::set_stack`.
  [[nodiscard]] bool set_stack(const StackOptions& options, double duration);

  [[nodiscard]] const TaskStack& tasks() const { return solved_->stack; }
  [[nodiscard]] const solver::Hierarchy& hierarchy() const { return solved_->stack.hierarchy(); }

 private:
  [[nodiscard]] bool is_fading() const { return fade_ && fade_->is_going_on(); }
  [[nodiscard]] double share() const;

  SolverOptions solver_options_;
  model::RobotDescription robot_;
  std::unique_ptr<SolvedStack> solved_;
  std::unique_ptr<StackFade>
      fade_;  // from the stack before, if there was one; kept when it is over
  LevelSwitcher switcher_;
};

}  // namespace surefoot::control
