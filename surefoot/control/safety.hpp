#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/control/leg_posture.hpp"
#include "surefoot/control/safety_options.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/signals/joint_command.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_health.hpp"
#include "surefoot/solver/solution.hpp"

#include <array>
#include <optional>

namespace surefoot::control {

/// The last stage of a tick: the command is always finite and within the torque limits.
///
/// Ladder:
///
///     optimal
///     degraded   the solver ended early, but after the levels that keep the physics
///     hold       joint PD about the last good posture, plus the last good torques; before the
///                first good tick about the first posture, plus the torques that carry the robot
///                (`bear`), for up to 2 s, so that it can settle
///     lifted,    joint PD about a given posture (`pose`), plus its share of the torques that carry
///     rise       the robot (`bear`): the robot is off its feet. Not latched; a lifted robot may
///                tilt
///     sit        joint PD along a motion to a lying posture, plus the last good torques, which
///                change within 0.4 s to those that carry the robot in its present posture.
///                Latched, after a sensor had no good sample for `bridge_time`, or has never had
///                one after repeated failures, and after those of the user's own code. Near the end
///                the torques fade and the PD softens. Joints of one leg with lost encoders keep
///                their last good torques until then
///     damping    τ = −k_d q̇, where k_d falls to a soft leg's within 1 s. Latched: after repeated
///                failures; lasting non-finite readings; too much tilt (before the first good tick
///                only after 30 ms, as the first readings may be wrong); failing joint sensors
///                while it tips over, as a fall can cause them; a fall, or failed rising
///                (`give_up`); the end of `sit`; or lost encoders of several legs, then plus the
///                torques before, which fade out within 0.5 s
///
/// An arm's joints are held as far as their drives are weaker than a leg's, and light ones softly
/// (`soften_light`), as are further joints of legs. The PD of a swing leg
/// (`set_standing`) is soft, as its inertia is small.
///
/// Torques change by at most `max_torque_change` a tick while the robot is off its feet, a sensor
/// is at fault or in doubt (`limit_next_change`), after every stop, and, if the first tick was not
/// good, until 0.5 s after the first good one. The limit stays until the torques have caught up.
/// Times are those of a robot of scale 1, but for the 30 ms.
class Safety {
 public:
  /// `first_free_level`: a solve that ended at or after this level is still usable. `lying`: final
  /// posture of `sit` [rad]. `period` of the control loop [s].
  Safety(const SafetyOptions& options, const model::RobotDescription& robot, int first_free_level,
         const JointVector& lying, double period);

  /// `state` may hold NaN; without its time, one period is assumed. `solution` is null if nothing
  /// was solved.
  [[nodiscard]] const JointCommand& command(const RobotState& state,
                                            const solver::Solution* solution,
                                            const SensorHealth& health = {}) noexcept;

  /// Drives are late: their PD would shake light bodies. Takes the inertia that the torque of each
  /// joint turns [kg·m²], and softens those of arms, and further ones of legs.
  void soften_light(const JointVector& inertia);
  /// The same of the HAA of legs that stand, which turn a narrow torso about their feet; takes its
  /// roll inertia with limp joints [kg·m²].
  void soften_roll(double inertia);

  /// For a new stack.
  void set_first_free_level(int level) { first_free_level_ = level; }

  /// Was there a good tick?
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  /// For ticks of a log, whose robot had begun.
  void assume_begun() { has_begun_ = true; }
  /// Sets the torques that carry the robot in its present posture [N·m], used before the first good
  /// tick, off its feet and after a stop. Ignores values that are not finite.
  void bear(const JointVector& torque) {
    if (!torque.allFinite()) return;
    bearing_torque_ = torque;
    if (!has_begun_) good_torque_ = torque;
  }
  /// Sets the stance legs of this tick; initially all. Those of the last good tick are used.
  void set_standing(const PerLeg<bool>& stands) { stands_now_ = stands; }

  /// At the next tick the robot is off its feet: its legs go to `posture`, whatever the solution.
  void pose(const LegPosture& posture, CommandMode mode) {
    posture_ = posture;
    pose_mode_ = mode;
  }
  /// Stops at the next tick: the robot can't stand, or has fallen.
  void give_up(StopCause cause) { given_up_ = cause; }

  /// Code of the user's own fails at this tick, and would be the cause of a stop.
  void blame_own_part() { own_part_failed_ = true; }

  /// Discards the last good tick; the torques continue, and so does the count of failures. Not for
  /// a robot that has stopped.
  void restart() noexcept;

  /// Limits the change of the torques at the next tick, as its inputs are in doubt.
  void limit_next_change() { limits_change_ = true; }

  /// It sits down or damps, for good.
  [[nodiscard]] bool has_stopped() const { return sitting_ || damping_; }
  [[nodiscard]] bool is_sitting_down() const { return sitting_ && !damping_; }

 private:
  [[nodiscard]] bool is_tilted(const RobotState& state) const;
  /// Is it too tilted soon, at its present rate?
  [[nodiscard]] bool will_tilt(const RobotState& state) const;
  [[nodiscard]] bool is_good(const RobotState& state, const solver::Solution* solution) const;
  void note_lame_joints(const RobotState& state, const SensorHealth& health);
  /// Can the robot sit down with the joints whose angles are known?
  [[nodiscard]] bool can_sit(const RobotState& state) const;
  /// Number of failures before a stop.
  [[nodiscard]] double max_failures(const RobotState& state, const SensorHealth& health) const;
  void check_for_stop(const RobotState& state, const SensorHealth& health);
  void stop_after_failures(const RobotState& state, const SensorHealth& health);
  void stop(CommandMode mode, StopCause cause, const SensorHealth& health);
  void follow(const RobotState& state, const solver::Solution& solution);
  void hold(const RobotState& state);
  /// PD torque towards q and q̇ [N·m]. `softness` of stance legs: 0 stiff, 1 soft; `spring`: factor
  /// of the proportional part.
  [[nodiscard]] JointVector pull(const RobotState& state, const JointVector& q,
                                 const JointVector& qd, double softness = 0.0,
                                 double spring = 1.0) const;
  void sit(const RobotState& state);
  void take_posture(const RobotState& state);
  void damp(const RobotState& state);
  void limit();
  void limit_change(const JointVector& before, bool wanted);

  SafetyOptions options_;
  JointVector torque_limit_;
  JointVector hold_kp_, hold_kd_, damping_kd_;
  JointVector spring_, damper_;  // of each joint, as a share of a leg's
  JointVector in_air_;           // factor of both for further joints of legs in the air
  Scale scale_;                  // of the robot
  int num_leg_joints_;
  PerLeg<JointRange> legs_, further_;
  double period_;
  int first_free_level_;
  JointVector lying_q_;
  int failures_ = 0;
  bool has_begun_ = false;
  bool sitting_ = false, damping_ = false;
  bool limits_change_ = false;  // at this tick
  LegPosture posture_;
  std::optional<CommandMode> pose_mode_;  // of this tick, with `posture_`
  StopCause given_up_ = StopCause::none;
  bool own_part_failed_ = false;         // at this tick
  bool change_is_limited_ = false;       // the last change of torque was limited
  std::array<bool, kMaxJoints> lame_{};  // joints whose encoders are lost
  double stopped_at_ = kNaN;             // [s]
  double fade_begin_ = kNaN;             // start of the damping for lost encoders [s], …
  JointVector fading_torque_;            // … on top of these
  int late_start_ticks_ = 0;             // left of a late start
  int damped_ticks_ = 0;                 // of damping
  JointVector stopped_q_, good_q_;
  JointVector good_torque_, bearing_torque_;
  double borne_ = 0.0;  // share of `bearing_torque_` while sitting down
  PerLeg<bool> stands_now_, stands_;
  JointCommand command_;
};

}  // namespace surefoot::control
