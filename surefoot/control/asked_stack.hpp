#pragma once

#include "surefoot/control/safety.hpp"
#include "surefoot/control/stack_fade.hpp"
#include "surefoot/signals/hierarchy_report.hpp"
#include "surefoot/signals/joint_command.hpp"

#include <string>
#include <vector>

namespace surefoot::control {

/// Result of a hierarchy at one tick.
struct StackAnswer {
  JointCommand command;
  HierarchyReport hierarchy;

  /// True if the torques are the hierarchy's. Otherwise it has no usable solution at this tick:
  /// its controller would hold the posture, or stop for `cause`.
  [[nodiscard]] bool is_usable() const {
    return command.mode == CommandMode::optimal || command.mode == CommandMode::degraded;
  }
};

/// Computes what another hierarchy would command, with the model and plan of a running controller.
/// A safety stop lasts for one tick only. Between ticks it keeps the solver's active rows and the
/// number of consecutive ticks without a usable solution, which leads to a stop.
class AskedStack {
 public:
  /// Throws Error on invalid options. Allocates here only.
  AskedStack(const StackOptions& stack, const SolverOptions& solver, const SafetyOptions& safety,
             const model::RobotDescription& robot);

  /// One tick, with all levels present. The reference stays valid until the next call.
  const StackAnswer& ask(const RobotState& state, const model::Dynamics& dynamics,
                         const MotionPlan& plan) noexcept;

  /// What a task of the user's own did wrong at this tick; empty if nothing.
  [[nodiscard]] std::string fault() const { return solved_.stack.fault().text(); }
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
