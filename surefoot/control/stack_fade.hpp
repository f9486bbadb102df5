#pragma once

#include "surefoot/control/hierarchy_solver.hpp"
#include "surefoot/control/task_stack.hpp"

#include <memory>

namespace surefoot::control {

/// A stack with its solver.
struct SolvedStack {
  SolvedStack(const StackOptions& options, const SolverOptions& solver_options,
              const model::RobotDescription& robot)
      : stack(options, robot), solver(stack.hierarchy(), solver_options) {}

  TaskStack stack;
  HierarchySolver solver;
};

/// Replaces a stack by another without a jump of the torques, by interpolation between the optima
/// of both (see `SoftLevels`).
class StackFade {
 public:
  /// From `before`, with the levels `present`, to a stack with as many levels and the capacity
  /// `after`; `duration` [s].
  StackFade(std::unique_ptr<SolvedStack> before, const solver::LevelSet& present,
            const solver::Hierarchy& after, double duration);

  /// True from the construction to the tick at which `share` is 1.
  [[nodiscard]] bool is_going_on() const { return share_ < 1.0; }
  [[nodiscard]] double share() const { return share_; }

  /// What an own task of the old stack did wrong in the last tick.
  [[nodiscard]] const PartFault& fault() const { return before_->stack.fault(); }

  /// Restarts at the next tick, unless it has ended, as the clock has changed.
  void restart() noexcept { begin_ = kNaN; }

  /// One tick at its time [s], with hierarchy and optimum of the new stack. The reference stays
  /// valid until the next call. Does not allocate.
  const solver::Solution& between(const model::Dynamics& dynamics, const MotionPlan& plan,
                                  double time, const solver::Hierarchy& hierarchy,
                                  const solver::Solution& after) noexcept;

 private:
  std::unique_ptr<SolvedStack> before_;
  LevelTransition at_rest_;  // of the old stack
  solver::SoftLevels soft_levels_;
  double duration_;
  double begin_;  // [s]; NaN before the first tick
  double share_ = 0.0;
};

}  // namespace surefoot::control
