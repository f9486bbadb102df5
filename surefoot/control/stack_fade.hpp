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

/// On the way from a stack to the one in its place, without a jump of the torques: what lies
/// between the optima of both (see `SoftLevels`).
class StackFade {
 public:
  /// From `before`, whose levels `present` have rows, to a stack with as many levels and the
  /// capacity `after`; `duration` [s].
  StackFade(std::unique_ptr<SolvedStack> before, const solver::LevelSet& present,
            const solver::Hierarchy& after, double duration);

  /// Begins with the first tick, and is over with the last; 0 … 1.
  [[nodiscard]] bool is_going_on() const { return share_ < 1.0; }
  [[nodiscard]] double share() const { return share_; }

  /// By another clock: one that is not over begins with the next tick.
  void begin_anew() noexcept { begin_ = kNaN; }

  /// One tick at its time [s], of which the new stack has the hierarchy and its optimum. The
  /// reference stays valid until the next call. Does not allocate.
  const solver::Solution& between(const model::Dynamics& dynamics, const MotionPlan& plan,
                                  double time, const solver::Hierarchy& hierarchy,
                                  const solver::Solution& after) noexcept;

 private:
  std::unique_ptr<SolvedStack> before_;
  LevelTransition at_rest_;  // of the stack before
  solver::SoftLevels soft_levels_;
  double duration_;
  double begin_;  // [s]; NaN before the first tick
  double share_ = 0.0;
};

}  // namespace surefoot::control
