#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// When the robot calibrates itself: at the start, at the user's request, and up to twice again
/// after a disturbed calibration that did not find legs and load.
class CalibrationSchedule {
 public:
  /// `scale` of the robot.
  explicit CalibrationSchedule(const CalibrationOptions& options, const Scale& scale = {})
      : motion_(options, scale), time_scale_(scale.time()) {}

  /// State of the user's switch before the first tick: not a request.
  void expect_switch(bool requested) { requested_before_ = requested; }
  /// A calibration begins at this time [s].
  void begin(double time);
  /// Did the calibration that has just ended find the legs and the payload?
  void tell_known(bool known) { is_known_ = known; }
  /// One tick at its time [s]. Turning the user's switch on, `requested`, requests a calibration.
  /// Missing ticks disturb a calibration like pushes do.
  void update(double time, bool requested, bool is_undisturbed);

  [[nodiscard]] bool is_going_on() const { return motion_stage() != CalibrationStage::none; }
  /// Is a calibration going on or waiting to begin?
  [[nodiscard]] bool is_due() const { return is_going_on() || is_wanted_; }
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }
  /// Of this tick; `settling` until a repeated calibration begins.
  [[nodiscard]] CalibrationStage stage() const { return stage_; }
  /// See CalibrationMotion.
  [[nodiscard]] Motion<Vec3> motion() const { return motion_.at(time_ - begun_at_); }

  /// How the last calibration ended, reported once; none: nothing to report.
  [[nodiscard]] PlanEvent take_end();
  /// That a calibration is waiting to begin, reported at each timeout.
  [[nodiscard]] PlanEvent take_waiting();

 private:
  [[nodiscard]] CalibrationStage motion_stage() const { return motion_.stage(time_ - begun_at_); }
  void want();
  void end();
  void give_up();

  CalibrationMotion motion_;
  double time_scale_;
  CalibrationStage stage_ = CalibrationStage::none;
  double time_ = 0.0, begun_at_ = 0.0;  // [s]
  bool requested_before_ = false;       // at the last tick
  bool is_wanted_ = false;              // waiting to begin
  double wait_timeout_at_ = 0.0;        // when the waiting is reported or given up [s]
  bool was_going_on_ = false;           // at the last tick
  bool was_disturbed_ = false;          // the present or last calibration
  bool is_known_ = false;               // legs and payload, after the last calibration
  bool will_repeat_ = false;            // the disturbed calibration
  bool may_give_up_ = false;            // the repetition, which no user requested
  int repeats_ = 0;                     // of a disturbed calibration
  PlanEvent end_ = PlanEvent::none;     // not yet reported
};

/// Measures how long the robot has stood still on all feet.
class RestWatch {
 public:
  explicit RestWatch(const Scale& scale) : scale_(scale) {}

  /// One tick. `stands`: the gait is standing, with all feet down.
  void update(const RobotState& state, bool stands);
  /// Has it stood still for 1 s, at scale 1, without turning?
  [[nodiscard]] bool is_at_rest(const RobotState& state) const;

 private:
  Scale scale_;                                  // of the robot
  double stands_from_ = 0.0, rests_from_ = 0.0;  // [s]
};

}  // namespace surefoot::gaits
