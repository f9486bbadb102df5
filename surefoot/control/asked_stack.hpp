#pragma once

#include "surefoot/control/safety.hpp"
#include "surefoot/control/stack_fade.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/signals/joint_command.hpp"

#include <string>
#include <vector>

namespace surefoot::control {

/// What a hierarchy says to one tick.
struct StackAnswer {
  JointCommand command;
  HierarchyReport hierarchy;

  /// Whether the torques are the hierarchy's. If not, it has no usable solution at this tick, and
  /// its controller would hold the posture, or has a `cause` to stop for safety.
  [[nodiscard]] bool is_usable() const {
    return command.mode == CommandMode::optimal || command.mode == CommandMode::degraded;
  }
};

/// A hierarchy that is asked beside a controller what it would command, on the model and the plan
/// that the controller has. Each tick is asked for itself: where it would have been stopped for
/// safety, it is asked again at the next. Of the ticks before it remembers from which rows its
/// solver begins, and how many in a row had no usable solution, after which it would be stopped.
class AskedStack {
 public:
  /// Throws Error on options that make no sense. Allocates here only.
  AskedStack(const StackOptions& stack, const SolverOptions& solver, const SafetyOptions& safety,
             const model::RobotDescription& robot);

  /// One tick, with all levels present. The reference stays valid until the next call.
  const StackAnswer& ask(const RobotState& state, const model::Dynamics& dynamics,
                         const MotionPlan& plan) noexcept;

  /// Names of the levels, highest priority first, and the units of their residuals.
  [[nodiscard]] std::vector<std::string> level_names() const;
  [[nodiscard]] std::vector<std::string> level_units() const { return solved_.stack.units(); }

 private:
  void command(const RobotState& state, const solver::Solution& solution,
               const PerLeg<bool>& stands) noexcept;

  SolvedStack solved_;
  LevelTransition at_rest_;  // with all levels
  Safety ladder_at_start_;
  Safety ladder_;
  StackAnswer answer_;
};

}  // namespace surefoot::control
