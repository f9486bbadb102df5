#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

#include <memory>
#include <vector>

namespace surefoot::gaits {

/// Plans the motion that the tasks follow. `make_planner` gives the library's; derive one of your
/// own for another motion. If it throws, or its plan can't be followed, the controller holds its
/// posture, then sits down.
class MotionPlanner {
 public:
  MotionPlanner() = default;
  MotionPlanner(const MotionPlanner&) = delete;
  MotionPlanner& operator=(const MotionPlanner&) = delete;
  virtual ~MotionPlanner() = default;

  /// One tick. `dynamics` is the model at `state`; `last` is what the hierarchy made of the plan
  /// before. The plan has the robot's number of feet, each with its force limits: a foot in stance
  /// with `force_max` 0 bears nothing. Must not allocate.
  [[nodiscard]] virtual const MotionPlan& update(const UserCommand& user, const RobotState& state,
                                                 const model::Dynamics& dynamics,
                                                 const HierarchyOutcome& last) = 0;
  /// Before an update: forgets all plans, as the robot may stand elsewhere.
  virtual void restart() = 0;

  [[nodiscard]] virtual int steps_taken() const noexcept { return 0; }
  /// Sets the friction coefficient of all feet. Throws Error unless above 0, or without a friction
  /// of its own.
  virtual void set_friction(double friction);

  // For the calibration before a walk; a planner without one need not override these.
  /// Unit normal of the terrain in W after the last plan.
  [[nodiscard]] virtual Vec3 terrain_normal(const MotionPlan& last) const noexcept {
    return last.R_WC.col(2);
  }
  /// Must the estimate restart before the next update, and the plan with it?
  [[nodiscard]] virtual bool restarts() const noexcept { return false; }
  /// Does nothing disturb a calibration?
  [[nodiscard]] virtual bool is_undisturbed(const RobotState&) const noexcept { return false; }
  /// Before an update: did the calibration that has just ended find legs and payload?
  virtual void tell_calibration_known(bool) noexcept {}
};

/// The library's: `Planner` with its gaits. `period` of the control loop [s], `scale` of the robot.
/// Throws Error on invalid options.
[[nodiscard]] std::unique_ptr<MotionPlanner> make_planner(const PlannerOptions& options,
                                                          double period, const Scale& scale = {},
                                                          const std::vector<NamedGait>& gaits = {},
                                                          int first = UserCommand::kOwnGait);

}  // namespace surefoot::gaits
