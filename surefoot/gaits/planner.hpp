#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/command_limits.hpp"
#include "surefoot/gaits/crawl/crawl.hpp"
#include "surefoot/gaits/parts/calibration_schedule.hpp"
#include "surefoot/gaits/parts/friction_frame.hpp"
#include "surefoot/gaits/parts/torso_reference.hpp"
#include "surefoot/gaits/rhythm/rhythmic_gait.hpp"
#include "surefoot/gaits/stand/flat_stand.hpp"
#include "surefoot/gaits/stand/stand.hpp"

namespace surefoot::gaits {

/// Plans the motion: selects the gait, stand, crawl or one by a clock, and does what all gaits
/// need: command limits, heading, torso along the plane through the footholds, calibration. A robot
/// with flat feet stands (`FlatStand`), whatever the command. Plans
/// relative to the footholds, independent of the world's origin.
class Planner {
 public:
  /// `period` of the control loop [s], `scale` of the robot. Throws Error unless the gait's order
  /// has each leg once.
  Planner(const PlannerOptions& options, double period, const Scale& scale = {});

  /// One tick. Allocates nothing, throws nothing.
  const MotionPlan& update(const UserCommand& command, const RobotState& state,
                           const model::Dynamics& dynamics,
                           const HierarchyOutcome& last = {}) noexcept;

  /// Before an update: resets to `fresh`, which has had no tick, but keeps the steps taken.
  void begin_anew(const Planner& fresh);

  /// Between two ticks: sets the friction coefficient of all feet. Throws Error unless above 0.
  void set_friction(double friction);

  /// Before an update: did the calibration that has just ended find the legs and the payload? If
  /// not, a disturbed calibration is repeated.
  void tell_calibration_known(bool known) { calibration_.tell_known(known); }

  /// Estimated unit normal of the terrain in W, filtered by the friction frame. Continuous, except
  /// when a calibration restarts the plan.
  [[nodiscard]] const Vec3& terrain_normal() const { return friction_frame_.normal(); }
  [[nodiscard]] int steps_taken() const { return body_.steps_taken; }
  /// Must the estimate restart before the next update, and the plan with it? For a calibration that
  /// the user requested or that is repeated, once the robot has stood still for 1 s.
  [[nodiscard]] bool restarts() const { return restarts_; }
  /// Is a calibration undisturbed: all feet planned to stand, no slip, no horizontal push? A
  /// vertical force may be a payload, which the calibration measures.
  [[nodiscard]] bool is_undisturbed(const RobotState& state) const;

 private:
  void initialise(const RobotState& state, const model::Dynamics& dynamics);
  /// A restart or a calibration of the estimate moves the footholds in W.
  void relearn_ground();
  [[nodiscard]] CommandContext command_context() const;
  /// The command for the gait; updates the heading.
  [[nodiscard]] UserCommand limit(const UserCommand& command);
  /// The gait of a walk.
  [[nodiscard]] Gait& walk() {
    return body_.options.rhythm.enabled ? static_cast<Gait&>(rhythmic_) : crawl_;
  }
  [[nodiscard]] const Gait& walk() const {
    return body_.options.rhythm.enabled ? static_cast<const Gait&>(rhythmic_) : crawl_;
  }
  [[nodiscard]] Gait& gait() { return walks_ ? walk() : stand_; }
  void move_legs(Situation& now);
  void finish_calibration(const RobotState& state);
  void write_plan(const Situation& now);

  Body body_;
  Stand stand_;
  FlatStand flat_stand_;
  Crawl crawl_;
  RhythmicGait rhythmic_;
  bool walks_ = false;  // the stand is not active
  CommandLimits limits_;
  TorsoReference torso_;
  FrictionFrame friction_frame_;
  CalibrationSchedule calibration_;
  RestWatch rest_;
  MotionPlan plan_;
  PerLeg<Vec2> hips_;                  // relative to the torso's centre, in heading axes [m]
  double yaw_ = 0.0, yaw_rate_ = 0.0;  // reference of the torso [rad], [rad/s]
  bool learns_ground_ = false;         // again after the calibration
  bool initialised_ = false;
  bool restarts_ = false;
};

}  // namespace surefoot::gaits
