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

/// The last stage of a tick: whatever came before, the command is finite and inside the torque
/// limits.
///
/// Ladder:
///
///     optimal
///     degraded   the solver ended early, but after the levels that keep the physics
///     hold       joint PD about the last good posture, on top of the last good torques; if there
///                never was a good tick, about the first posture that was seen, on top of those
///                that bear the robot (`bear`): for 2 s then, so that it comes to stand
///     lifted,    joint PD about a posture that is given (`pose`), on top of as much of the torques
///     rise       that bear the robot (`bear`) as this says: the robot is not on its feet. Not
///                latched; a lifted robot may tilt
///     sit        joint PD on the way to a lying posture, on top of the last good torques, which
///                turn into those that bear the robot in the posture that it has within 0.4 s,
///                latched: a sensor gave nothing good for longer than `bridge_time`, or after
///                repeated failures nothing at all yet. As it comes to lie the torques fade and the
///                PD softens. Joints of one leg whose encoders are lost keep their last good
///                torques until these fade, and so do the others then
///     damping    τ = −k_d q̇, latched, where k_d falls to that of a soft leg within 1 s: after
///                repeated failures, non-finite readings that last, or a torso tilted too far
///                (before the first good tick only when 30 ms have gone by, as the first readings
///                may be wrong); where joint sensors fail as it tips over, since joints of a
///                falling robot do what their sensors can't follow; lifted, as it seems, but on its
///                torso, or unable to stand (`give_up`); lying; or at once where
///                encoders of several legs are lost, on top of the last good torques, or those of
///                the way down, which fade out within 0.5 s
///
/// The PD of a leg that does not stand (`set_standing`) is soft, for its inertia is small.
///
/// While the robot is not on its feet or a sensor is at fault, or where its samples may be wrong
/// (`be_careful`), and after that until they are back where they should be, after every stop, and
/// where the first tick was not good until 0.5 s after the first that was, torques change by no
/// more than `max_torque_change` a tick. Times are those of a robot of scale 1, but for the 30 ms.
class Safety {
 public:
  /// `first_free_level`: a solve that ended at or after this level is still usable. `lying`: where
  /// `sit` leads [rad]. `period` of the control loop [s].
  Safety(const SafetyOptions& options, const model::RobotDescription& robot, int first_free_level,
         const JointVector& lying, double period);

  /// `state` may hold NaN, and without a time a period has gone by; `solution` is null where the
  /// tick could not come to solve.
  [[nodiscard]] const JointCommand& command(const RobotState& state,
                                            const solver::Solution* solution,
                                            const SensorHealth& health = {}) noexcept;

  /// For another stack.
  void set_first_free_level(int level) { first_free_level_ = level; }

  /// Was there a good tick?
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  /// For ticks of a log: its robot had begun.
  void skip_beginning() { has_begun_ = true; }
  /// What bears the robot in its posture of this tick [N·m], until there is a good one and when it
  /// has stopped. Where it is not finite nothing changes.
  void bear(const JointVector& torque) {
    if (!torque.allFinite()) return;
    bearing_torque_ = torque;
    if (!has_begun_) good_torque_ = torque;
  }
  /// The legs that bear the robot at this tick: all, unless told. What counts is the last good one.
  void set_standing(const PerLeg<bool>& stands) { stands_now_ = stands; }

  /// At the next tick the robot is not on its feet: its legs go there, whatever the solution.
  void pose(const LegPosture& posture, CommandMode mode) {
    posture_ = posture;
    posed_ = mode;
  }
  /// It can't stand, or fell: it stops at the next tick.
  void give_up(StopCause cause) { given_up_ = cause; }

  /// What was good so far is worth nothing; the torques go on from where they are, and how long it
  /// has not been good counts on. Not for a robot that has stopped.
  void begin_anew() noexcept;

  /// Torques change slowly at the next tick: what it is given may not be true.
  void be_careful() { is_careful_ = true; }

  /// For good: no solution is asked for any more.
  [[nodiscard]] bool has_stopped() const { return sitting_ || damping_; }
  [[nodiscard]] bool is_sitting_down() const { return sitting_ && !damping_; }

 private:
  [[nodiscard]] bool is_tilted(const RobotState& state) const;
  /// Will it be tilted soon, as it turns now?
  [[nodiscard]] bool tips(const RobotState& state) const;
  [[nodiscard]] bool is_good(const RobotState& state, const solver::Solution* solution) const;
  void note_lame_joints(const RobotState& state, const SensorHealth& health);
  /// Can the robot sit down with the joints whose angles are known?
  [[nodiscard]] bool can_sit(const RobotState& state) const;
  /// How many failures are borne.
  [[nodiscard]] double patience(const RobotState& state, const SensorHealth& health) const;
  void look_for_a_stop(const RobotState& state, const SensorHealth& health);
  void stop_after_failures(const RobotState& state, const SensorHealth& health);
  void stop(CommandMode mode, StopCause cause, const SensorHealth& health);
  void follow(const RobotState& state, const solver::Solution& solution);
  void hold(const RobotState& state);
  /// Towards q and q̇, where the PD of legs that stand is as hard (0) or soft (1) as this, and of
  /// its spring this share is left.
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
  double hold_kp_, hold_kd_, damping_kd_;
  Scale scale_;  // of the robot
  double period_;
  int first_free_level_;
  JointVector lying_q_;
  int failures_ = 0;
  bool has_begun_ = false;  // there was a good tick
  bool sitting_ = false, damping_ = false;
  bool is_careful_ = false;  // at this tick
  LegPosture posture_;
  std::optional<CommandMode> posed_;  // at this tick, to `posture_`
  StopCause given_up_ = StopCause::none;
  bool catching_up_ = false;             // torques that were limited in their change
  std::array<bool, kNumJoints> lame_{};  // joints whose encoders are lost
  double stopped_at_ = kNaN;             // [s]
  double damped_at_ = kNaN;              // where encoders were lost that it needs [s], …
  JointVector fading_torque_ = JointVector::Zero();  // … on top of these
  int unsteady_ticks_ = 0;                           // left of a late beginning
  int damped_ticks_ = 0;                             // since it damps
  JointVector stopped_q_ = JointVector::Constant(kNaN);
  JointVector good_q_ = JointVector::Constant(kNaN);
  JointVector good_torque_ = JointVector::Zero();
  JointVector bearing_torque_ = JointVector::Constant(kNaN);
  double borne_ = 0.0;  // share of the bearing torque on the way down
  PerLeg<bool> stands_now_{}, stands_{};
  JointCommand command_;
};

}  // namespace surefoot::control
