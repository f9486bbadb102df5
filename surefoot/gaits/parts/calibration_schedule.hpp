#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/calibration_motion.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// When the robot calibrates itself: at the beginning, when it is asked to, and once more after a
/// calibration that was disturbed and doesn't know legs and load, twice at most. The planner says
/// when one may begin.
class CalibrationSchedule {
 public:
  /// `scale` of the robot.
  explicit CalibrationSchedule(const CalibrationOptions& options, const Scale& scale = {})
      : motion_(options, scale) {}

  /// The user's switch stands like that before the first tick, which asks for nothing.
  void expect_switch(bool asked) { asked_before_ = asked; }
  /// A calibration begins at this time [s].
  void begin(double time);
  /// Does the calibration that has just ended know the legs and what the robot carries?
  void tell_known(bool known) { is_known_ = known; }
  /// One tick at its time [s]: the user's switch, which asks when it is turned on, and whether a
  /// calibration may listen. Ticks that are missing disturb it, too.
  void update(double time, bool asked, bool is_undisturbed);

  [[nodiscard]] bool is_going_on() const { return motion_stage() != CalibrationStage::none; }
  /// … or is to begin as soon as it may.
  [[nodiscard]] bool is_due() const { return is_going_on() || is_wanted_; }
  [[nodiscard]] bool is_wanted() const { return is_wanted_; }
  /// Of this tick. It still settles where it will calibrate once more.
  [[nodiscard]] CalibrationStage stage() const { return stage_; }
  /// See CalibrationMotion.
  [[nodiscard]] Motion<Vec3> motion() const { return motion_.at(time_ - begun_at_); }

  /// How the last one ended, if that is still to be told; once.
  [[nodiscard]] PlanEvent take_end();
  /// That one waits to begin, if it is time to tell; again and again.
  [[nodiscard]] PlanEvent take_waiting();

 private:
  [[nodiscard]] CalibrationStage motion_stage() const { return motion_.stage(time_ - begun_at_); }
  void want();
  void end();
  void give_up();

  CalibrationMotion motion_;
  CalibrationStage stage_ = CalibrationStage::none;
  double time_ = 0.0, begun_at_ = 0.0;  // [s]
  bool asked_before_ = false;           // at the last tick
  bool is_wanted_ = false;              // one that has not begun
  double tells_wait_at_ = 0.0;          // that it has not [s]
  bool was_going_on_ = false;           // at the last tick
  bool was_disturbed_ = false;          // the one that goes on, or the last one
  bool is_known_ = false;               // after it
  bool will_repeat_ = false;            // that one, as soon as it may begin
  bool may_give_up_ = false;            // to repeat it, as nobody has asked for one
  int repeats_ = 0;                     // of one that was disturbed
  PlanEvent end_ = PlanEvent::none;     // that is still to be told
};

/// Since when a robot has stood on all feet without going anywhere.
class RestWatch {
 public:
  explicit RestWatch(const Scale& scale) : scale_(scale) {}

  /// One tick. `stands`: the gait lets all feet stand, and they do.
  void update(const RobotState& state, bool stands);
  /// For 1 s, at scale 1, and it does not turn.
  [[nodiscard]] bool is_at_rest(const RobotState& state) const;

 private:
  Scale scale_;                                  // of the robot
  double stands_from_ = 0.0, rests_from_ = 0.0;  // [s]
};

}  // namespace surefoot::gaits
