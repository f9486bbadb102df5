#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot::gaits {

/// A robot with flat feet stands: the feet stay, the torso is level, and centre of mass and height
/// follow the command `shift` and `height`, smoothly and no further than this:
///
///     forward, back   half of half a sole            up     nothing
///     to the sides    over the centre of a foot      down   a quarter of the height at the start
///
/// Nothing is done about feet that tip or slide. Does not allocate.
class FlatStand {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  FlatStand(const ForceOptions& force, double period, const Scale& scale)
      : force_(force), period_(period), scale_(scale) {}

  /// One tick: writes the plan. Begins at the first one.
  void update(const UserCommand& command, const RobotState& state, const model::Dynamics& dynamics,
              MotionPlan& plan) noexcept;

  /// Of the feet, from the next update on; above 0.
  void set_friction(double friction) { force_.friction = friction; }

 private:
  /// A reference that goes to its target, critically damped.
  struct Reference {
    double p = 0.0, v = 0.0, a = 0.0;
    void follow(double target, double rate, double dt);
  };

  void follow_feet(const model::Dynamics& dynamics, MotionPlan& plan);
  void begin(const RobotState& state, const model::Dynamics& dynamics, MotionPlan& plan);
  void plan_com(const model::Dynamics& dynamics, MotionPlan& plan) const;

  ForceOptions force_;
  double period_;
  Scale scale_;
  bool has_begun_ = false;
  double yaw_ = 0.0, height_ = 0.0;  // at the start [rad], over the feet [m]
  Vec3 middle_ = Vec3::Zero();       // of the feet, in W [m]
  Vec2 reach_ = Vec2::Zero();        // largest shift, forward and to the sides [m]
  Reference forward_, left_, up_;    // from the middle, and from `height_`
};

}  // namespace surefoot::gaits
