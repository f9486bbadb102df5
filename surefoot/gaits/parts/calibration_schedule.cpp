#include "surefoot/gaits/parts/calibration_schedule.hpp"

#include <algorithm>
#include <utility>

namespace surefoot::gaits {
namespace {

constexpr double kPatience = 10.0;     // until it is told that a calibration waits to begin, and a
                                       // repeated one is given up [s]
constexpr int kMostRepeats = 2;        // of a calibration that is disturbed
constexpr double kLongestGap = 0.011;  // between two ticks; a longer one disturbs, too [s]
constexpr double kStill = 0.02;        // [m/s] and [rad/s]
constexpr double kRestDuration = 1.0;  // [s]

}  // namespace

void CalibrationSchedule::begin(double time) {
  time_ = begun_at_ = time;
  is_wanted_ = will_repeat_ = may_give_up_ = was_disturbed_ = false;
}

void CalibrationSchedule::update(double time, bool asked, bool is_undisturbed) {
  const bool is_cut = time - time_ > kLongestGap;
  time_ = time;
  const bool listened = stage_ == CalibrationStage::turning || stage_ == CalibrationStage::weighing;
  if (listened && (!is_undisturbed || is_cut)) was_disturbed_ = true;
  if (was_going_on_ && !is_going_on()) end();
  was_going_on_ = is_going_on();
  if (may_give_up_ && time_ >= tells_wait_at_) give_up();
  if (asked && !asked_before_) {
    repeats_ = 0;
    may_give_up_ = false;  // as it was asked for, it waits as long as it has to
    want();
  }
  asked_before_ = asked;
  stage_ = motion_stage();
  if (will_repeat_ && stage_ == CalibrationStage::none) stage_ = CalibrationStage::settling;
}

void CalibrationSchedule::want() {
  is_wanted_ = true;
  tells_wait_at_ = time_ + kPatience;
}

// Not for ever: somebody who goes on pushing wants the robot to walk.
void CalibrationSchedule::end() {
  if (!was_disturbed_ || is_known_) {
    repeats_ = 0;
  } else if (is_wanted_ || repeats_ < kMostRepeats) {
    may_give_up_ = !is_wanted_;  // asked for meanwhile, it waits as long as it has to
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

// So that whoever asked sees why nothing happens.
PlanEvent CalibrationSchedule::take_waiting() {
  if (!is_wanted_ || is_going_on() || time_ < tells_wait_at_) return PlanEvent::none;
  tells_wait_at_ = time_ + kPatience;
  return PlanEvent::calibration_waits;
}

void RestWatch::update(const RobotState& state, bool stands) {
  if (!stands) stands_from_ = state.time;
  if (!(state.v_WB.norm() < scale_.speed() * kStill)) rests_from_ = state.time;
}

bool RestWatch::is_at_rest(const RobotState& state) const {
  return state.time > std::max(stands_from_, rests_from_) + scale_.time() * kRestDuration &&
         state.w_WB_B.norm() < scale_.rate() * kStill;
}

}  // namespace surefoot::gaits
