#include "surefoot/planning/calibration_schedule.hpp"

#include <utility>

namespace surefoot {
namespace {

constexpr double kPatience = 10.0;  // until it is told that a calibration waits to begin, and a
                                    // repeated one is given up [s]
constexpr int kMostRepeats = 2;     // of a calibration that is disturbed

}  // namespace

void CalibrationSchedule::begin(double time) {
  time_ = begun_at_ = time;
  is_wanted_ = will_repeat_ = was_disturbed_ = false;
}

void CalibrationSchedule::update(double time, bool asked, bool is_undisturbed) {
  time_ = time;
  const bool listened = stage_ == CalibrationStage::turning || stage_ == CalibrationStage::weighing;
  if (listened && !is_undisturbed) was_disturbed_ = true;
  if (was_going_on_ && !is_going_on()) end();
  was_going_on_ = is_going_on();
  if (will_repeat_ && time_ >= tells_wait_at_) give_up();
  if (asked && !asked_before_) {
    repeats_ = 0;
    will_repeat_ = false;  // as it was asked for, it waits as long as it has to
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
  if (!was_disturbed_ || load_known_) {
    repeats_ = 0;
  } else if (repeats_ < kMostRepeats) {
    ++repeats_;
    will_repeat_ = !is_wanted_;  // asked for meanwhile, it waits as long as it has to
    end_ = PlanEvent::calibration_disturbed;
    want();
  } else {
    give_up();
  }
}

void CalibrationSchedule::give_up() {
  if (will_repeat_) is_wanted_ = false;
  will_repeat_ = false;
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

}  // namespace surefoot
