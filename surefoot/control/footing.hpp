#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/control/leg_posture.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/estimation/lift_detector.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/signals/per_leg.hpp"
#include "surefoot/signals/plan_event.hpp"

namespace surefoot::control {

/// Moves the legs of a robot that is off its feet: lifted, or lying.
///
///     stands   normal operation
///     hangs    lifted (LiftDetector): the legs move to the stance posture within a second and are
///              held there softly, until the feet carry the robot
///     folds    at the start it lies: the feet move under the hips
///     rises    the legs extend to the stance posture, with the torques that carry the robot
///
/// After rising it stands, and estimate and plan restart. Knees stay on the side of their first
/// reading. A robot that does not reach the stance, or tips while rising, `has_failed`. A robot
/// with a tilted torso, or without feet below it, was not lifted: it `has_fallen`. Does not
/// allocate.
class Footing {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  Footing(const gaits::StanceOptions& stance, double period, const Scale& scale = {})
      : stance_(stance), period_(period), scale_(scale) {}

  /// Before the first stand: finds the side of the knees, and whether the robot lies. Ignores q
  /// [rad] that is not finite.
  void look_at_start(const model::RobotModel& model, const JointVector& q) noexcept;

  /// One tick, with `lift` of this tick. Returns the event of this tick, if any.
  PlanEvent update(const model::RobotModel& model, const RobotState& state,
                   const estimation::LiftDetector& lift) noexcept;

  [[nodiscard]] bool stands() const { return state_ == State::stands; }
  [[nodiscard]] bool hangs() const { return state_ == State::hangs; }
  /// It stood up at the last update: estimate and plan restart.
  [[nodiscard]] bool restarts() const { return restarts_; }
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  /// It stood before and has fallen.
  [[nodiscard]] bool has_fallen() const { return has_fallen_; }
  /// Leg posture while it does not stand.
  [[nodiscard]] LegPosture posture(const estimation::LiftDetector& lift) const;
  /// What turns a rising robot upright, as its springs alone would let it tip: the moment of its
  /// inertia times ω² θ − 2 ζ ω w, with the tilt θ from z_B to z_W.
  [[nodiscard]] Righting righting(const model::Dynamics& dynamics, const RobotState& state) const;

 private:
  enum class State { stands, hangs, folds, rises };

  /// Starts a motion from the present posture to another, at rest at both ends.
  void go(State state, const JointVector& q, const JointVector& to);
  void rise(const model::RobotModel& model, const JointVector& q, double borne);
  PlanEvent update_rise(const model::RobotModel& model, const RobotState& state,
                        const estimation::LiftDetector& lift);
  PlanEvent hang(const model::RobotModel& model, const JointVector& q);
  /// With the base at this height over the feet [m].
  [[nodiscard]] bool is_low(double height) const;
  /// Does the ground carry the robot's body, instead of somebody who lifts it?
  [[nodiscard]] bool lies(const model::RobotModel& model, const RobotState& state) const;
  /// Stance posture with another height of the base above the feet [m].
  [[nodiscard]] JointVector posture_at(const model::RobotModel& model, double height) const;

  gaits::StanceOptions stance_;
  double period_;
  Scale scale_;
  State state_ = State::stands;
  PerLeg<double> knees_ = per_leg(1.0);  // side at the start: ±1
  JointVector from_, to_;
  double time_ = 0.0, duration_ = 1.0;  // of the motion [s]
  double borne_ = 0.0;                  // initial share of the weight on the feet
  double stood_for_ = 0.0;              // while rising [s]
  bool restarts_ = false, has_failed_ = false, has_fallen_ = false;
};

}  // namespace surefoot::control
