#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/runtime/stage_timer.hpp"

#include <memory>
#include <string>
#include <utility>

namespace surefoot::python {

/// `Controller` in Python: one of its own with the time that its stages take, or that of a run.
class BoundController {
 public:
  BoundController(model::RobotDescription robot, std::unique_ptr<control::Controller> controller)
      : robot_(std::move(robot)),
        own_(std::move(controller)),
        controller_(own_.get()),
        timer_(std::make_unique<runtime::StageTimer>()) {
    own_->set_stage_observer(timer_.get());
  }
  /// `controller` is another's and must outlive this.
  BoundController(model::RobotDescription robot, control::Controller& controller)
      : robot_(std::move(robot)), controller_(&controller) {}

  control::Controller& operator*() { return *controller_; }
  control::Controller* operator->() { return controller_; }
  const control::Controller* operator->() const { return controller_; }
  [[nodiscard]] const model::RobotDescription& robot() const { return robot_; }
  /// What a part of the user's own did wrong, when it does so first.
  [[nodiscard]] std::string new_fault() {
    std::string fault = controller_->fault();
    if (fault == told_) return {};
    return told_ = fault;
  }
  /// Of the last tick; in a run it is not known.
  [[nodiscard]] TickTiming timing() const { return timer_ ? timer_->timing() : TickTiming{}; }

 private:
  model::RobotDescription robot_;
  std::unique_ptr<control::Controller> own_;
  control::Controller* controller_;
  std::unique_ptr<runtime::StageTimer> timer_;
  std::string told_;
};

}  // namespace surefoot::python
