#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/command_limits.hpp"
#include "surefoot/gaits/crawl/crawl.hpp"
#include "surefoot/gaits/parts/calibration_schedule.hpp"
#include "surefoot/gaits/parts/friction_frame.hpp"
#include "surefoot/gaits/parts/torso_reference.hpp"
#include "surefoot/gaits/stand/stand.hpp"

namespace surefoot::gaits {

/// Plans the motion: gives the legs to a gait, stand or crawl, and does what all gaits need: limits
/// of the command, heading, torso along the plane through the footholds, calibration. Plans
/// relative to the footholds; nothing depends on where the world's origin lies.
class Planner {
 public:
  /// `period` of the control loop [s], `scale` of the robot. Throws Error unless the gait's order
  /// has each leg once.
  Planner(const PlannerOptions& options, double period, const Scale& scale = {});

  /// One tick. Allocates nothing, throws nothing.
  const MotionPlan& update(const UserCommand& command, const RobotState& state,
                           const model::Dynamics& dynamics,
                           const HierarchyOutcome& last = {}) noexcept;

  /// Before an update: a plan that knows what `fresh` does, which has not begun; but for the steps
  /// taken.
  void begin_anew(const Planner& fresh);

  /// Between two ticks: the friction that every foot is believed to find from now on. Throws Error
  /// unless it is above 0.
  void set_friction(double friction);

  /// Before an update: does the calibration that has just ended know the legs and what the robot
  /// carries? Only one that was disturbed and doesn't is repeated.
  void tell_calibration_known(bool known) { calibration_.tell_known(known); }

  /// Unit normal of the terrain as believed, in W, through the filter of the friction frame: it
  /// lags, and jumps only where a calibration begins the plan anew.
  [[nodiscard]] const Vec3& terrain_normal() const { return friction_frame_.normal(); }
  [[nodiscard]] int steps_taken() const { return body_.steps_taken; }
  /// Is the estimate to begin anew before the next update, and the plan with it? As the user asked,
  /// or after a calibration that was disturbed, once all feet stand and nothing has moved for 1 s.
  [[nodiscard]] bool restarts() const { return restarts_; }
  /// May a calibration listen? By the last plan all feet stand, none slides, and nobody pushes. A
  /// payload, which pushes downward, is what it listens to.
  [[nodiscard]] bool is_undisturbed(const RobotState& state) const;

 private:
  void initialise(const RobotState& state, const model::Dynamics& dynamics);
  /// An estimate that begins anew has other places for the same feet, and others again when it is
  /// calibrated.
  void learn_ground_anew();
  [[nodiscard]] CommandRoom room() const;
  /// The command that the gait gets; turns the heading.
  [[nodiscard]] UserCommand limit(const UserCommand& command);
  [[nodiscard]] Gait& gait() { return walks_ ? static_cast<Gait&>(crawl_) : stand_; }
  void move_legs(Situation& now);
  void finish_calibration(const RobotState& state);
  void write_plan(const Situation& now);

  Body body_;
  Stand stand_;
  Crawl crawl_;
  bool walks_ = false;  // the crawl has the legs
  CommandLimits limits_;
  TorsoReference torso_;
  FrictionFrame friction_frame_;
  CalibrationSchedule calibration_;
  RestWatch rest_;
  MotionPlan plan_;
  PerLeg<Vec2> hips_;                  // about the torso's centre, in heading axes [m]
  double yaw_ = 0.0, yaw_rate_ = 0.0;  // that the torso is to have
  bool learns_ground_ = false;         // once more, as soon as the calibration is over
  bool initialised_ = false;
  bool restarts_ = false;
};

}  // namespace surefoot::gaits
