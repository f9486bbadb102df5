#include "surefoot/closed_loop/stop_watch.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/logging/stop_text.hpp"
#include "surefoot/signals/joint_name.hpp"

namespace surefoot::closed_loop {

std::string with_fault(const std::string& reason, const std::string& fault) {
  return fault.empty() ? reason : reason + ", and a part of your own failed: " + fault;
}

StopWatch::StopWatch(const model::RobotDescription& robot)
    : joints_(told_joints(robot.joint_names(), robot.num_legs())) {}

void StopWatch::update(const control::Controller& controller, double time) {
  const StopCause cause = controller.record().command.cause;
  if (cause == StopCause::none || has_stopped()) return;
  time_ = time;
  why_ = logging::text_of_stop(controller.record(), joints_);
  if (cause == StopCause::own_part) why_ += ": " + controller.fault();
}

bool StopWatch::has_stopped() const { return time_.has_value(); }

std::string StopWatch::reason(const std::string& fall) const {
  return formatted("the controller stopped for safety at %.4f s: ", time_.value_or(0.0)) + why_ +
         (fall.empty() ? "" : ", then " + fall);
}

}  // namespace surefoot::closed_loop
