#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/control/leg_posture.hpp"
#include "surefoot/estimation/lift_detector.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/signals/plan_event.hpp"

namespace surefoot::control {

/// What a robot does that is not on its feet: one that is lifted, or that lies.
///
///     stands   the walk
///     hangs    its feet bear little and it does not fall (LiftDetector): the legs go to the
///              stance's posture within a second and are held there softly, until the feet bear it
///     folds    it begins with its feet too high for a stance: the feet go under the hips
///     rises    the legs stretch to the stance's posture, with the torques that bear the robot
///
/// and from there it stands, with estimate and plan begun anew. Knees stay on the side where they
/// were at the start. A robot that does not come to stand, or tips on the way, can't: `has_failed`.
/// A robot whose torso leans, or whose feet are not below it, was not lifted but fell:
/// `has_fallen`. Does not allocate.
class Footing {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  Footing(const gaits::StanceOptions& stance, double period, const Scale& scale = {})
      : stance_(stance), period_(period), scale_(scale) {}

  /// Before a robot stands for the first time: where are its knees, and does it lie? Nothing
  /// happens where q [rad] is not known.
  void look_at_start(const model::RobotModel& model, const JointVector& q) noexcept;

  /// One tick: the state, and `lift` of this tick. What has happened.
  PlanEvent update(const model::RobotModel& model, const RobotState& state,
                   const estimation::LiftDetector& lift) noexcept;

  [[nodiscard]] bool stands() const { return state_ == State::stands; }
  [[nodiscard]] bool hangs() const { return state_ == State::hangs; }
  /// It came to stand at the last update: estimate and plan begin anew.
  [[nodiscard]] bool restarts() const { return restarts_; }
  [[nodiscard]] bool has_failed() const { return has_failed_; }
  /// It walked, and the torso lies on the ground.
  [[nodiscard]] bool has_fallen() const { return has_fallen_; }
  /// While it does not stand.
  [[nodiscard]] LegPosture posture(const estimation::LiftDetector& lift) const;

 private:
  enum class State { stands, hangs, folds, rises };

  /// From where the joints are to another posture, at rest at both ends.
  void go(State state, const JointVector& q, const JointVector& to);
  void rise(const model::RobotModel& model, const JointVector& q, double borne);
  PlanEvent update_rise(const model::RobotModel& model, const RobotState& state,
                        const estimation::LiftDetector& lift);
  PlanEvent hang(const model::RobotModel& model, const JointVector& q);
  /// With the base at this height over the feet [m].
  [[nodiscard]] bool is_low(double height) const;
  /// Of a robot that something else than its feet holds: is that the ground?
  [[nodiscard]] bool lies(const model::RobotModel& model, const RobotState& state) const;
  /// Feet at their places of the stance but for the height of the base over them [m].
  [[nodiscard]] JointVector posture_at(const model::RobotModel& model, double height) const;

  gaits::StanceOptions stance_;
  double period_;
  Scale scale_;
  State state_ = State::stands;
  PerLeg<double> knees_{1.0, 1.0, 1.0, 1.0};  // sides on which they were at the start: ±1
  JointVector from_ = JointVector::Zero(), to_ = JointVector::Zero();
  double time_ = 0.0, duration_ = 1.0;  // of the way [s]
  double borne_ = 0.0;                  // share of the weight on the feet when it began to rise
  double stood_for_ = 0.0;              // since then [s]
  bool restarts_ = false, has_failed_ = false, has_fallen_ = false;
};

}  // namespace surefoot::control
