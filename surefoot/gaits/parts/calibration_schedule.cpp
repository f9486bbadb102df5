#include "surefoot/gaits/parts/calibration_schedule.hpp"

#include <algorithm>
#include <utility>

namespace surefoot::gaits {
namespace {

constexpr double kWaitTimeout = 10.0;  // then a waiting calibration is reported, or given up [s]
constexpr int kMaxRepeats = 2;         // of a disturbed calibration
constexpr double kMaxTickGap = 0.011;  // a longer gap disturbs a calibration [s]
constexpr double kRestSpeed = 0.02;    // [m/s] and [rad/s]
constexpr double kRestDuration = 1.0;  // [s]

}  // namespace

void CalibrationSchedule::begin(double time) {
  time_ = begun_at_ = time;
  is_wanted_ = will_repeat_ = may_give_up_ = was_disturbed_ = false;
}

void CalibrationSchedule::update(double time, bool requested, bool is_undisturbed) {
  const bool has_gap = time - time_ > kMaxTickGap;
  time_ = time;
  const bool listened = stage_ == CalibrationStage::turning || stage_ == CalibrationStage::weighing;
  if (listened && (!is_undisturbed || has_gap)) was_disturbed_ = true;
  if (was_going_on_ && !is_going_on()) end();
  was_going_on_ = is_going_on();
  if (may_give_up_ && time_ >= wait_timeout_at_) give_up();
  if (requested && !requested_before_) {
    repeats_ = 0;
    may_give_up_ = false;  // a calibration that the user requested waits without limit
    want();
  }
  requested_before_ = requested;
  stage_ = motion_stage();
  if (will_repeat_ && stage_ == CalibrationStage::none) stage_ = CalibrationStage::settling;
}

void CalibrationSchedule::want() {
  is_wanted_ = true;
  wait_timeout_at_ = time_ + time_scale_ * kWaitTimeout;
}

// Repeats are limited, so that a lasting push does not keep the robot from walking.
void CalibrationSchedule::end() {
  if (!was_disturbed_ || is_known_) {
    repeats_ = 0;
  } else if (is_wanted_ || repeats_ < kMaxRepeats) {
    may_give_up_ = !is_wanted_;  // unless the user has requested one meanwhile
    if (may_give_up_) ++repeats_;
    will_repeat_ = true;
    end_ = PlanEvent::calibration_disturbed;
    want();
  } else {
    give_up();
  }
}

void CalibrationSchedule::give_up() {
  is_wanted_ = will_repeat_ = may_give_up_ = false;
  repeats_ = 0;
  end_ = PlanEvent::calibration_given_up;
}

PlanEvent CalibrationSchedule::take_end() { return std::exchange(end_, PlanEvent::none); }

PlanEvent CalibrationSchedule::take_waiting() {
  if (!is_wanted_ || is_going_on() || time_ < wait_timeout_at_) return PlanEvent::none;
  wait_timeout_at_ = time_ + time_scale_ * kWaitTimeout;
  return PlanEvent::calibration_waits;
}

void RestWatch::update(const RobotState& state, bool stands) {
  if (!stands) stands_from_ = state.time;
  if (!(state.v_WB.norm() < scale_.speed() * kRestSpeed)) rests_from_ = state.time;
}

bool RestWatch::is_at_rest(const RobotState& state) const {
  return state.time > std::max(stands_from_, rests_from_) + scale_.time() * kRestDuration &&
         state.w_WB_B.norm() < scale_.rate() * kRestSpeed;
}

}  // namespace surefoot::gaits
