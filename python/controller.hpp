#pragma once

#include "python/changes.hpp"
#include "python/lent.hpp"
#include "python/level_outcome.hpp"
#include "python/named_command.hpp"
#include "python/robot.hpp"
#include "surefoot/config/scenario.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/runtime/stage_timer.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {

/// `Controller` in Python: one of its own with the time that its stages take, or that of a run.
class BoundController : public Lent<control::Controller> {
 public:
  BoundController(const config::Scenario& scenario, std::unique_ptr<control::Controller> controller)
      : Lent(std::move(controller), "controller", true),
        robot_(scenario.robot),
        options_(scenario.options_json),
        gaits_(gaits_of(scenario)),
        timer_(std::make_unique<runtime::StageTimer>()) {
    (**this).set_stage_observer(timer_.get());
  }
  BoundController(const config::Scenario& scenario, control::Controller& of_run)
      : Lent(of_run, "controller", true),
        robot_(scenario.robot),
        options_(scenario.options_json),
        gaits_(gaits_of(scenario)) {}

  [[nodiscard]] const model::RobotDescription& robot() const { return robot_; }
  /// The same as Python's, made when it is asked for.
  [[nodiscard]] std::shared_ptr<Robot> shared_robot() const {
    if (!shared_robot_) shared_robot_ = std::make_shared<Robot>(robot_);
    return shared_robot_;
  }
  /// The scenario's, as JSON.
  [[nodiscard]] const std::string& options() const { return options_; }
  /// With the interpreter's lock. Throws Error on a command that makes no sense.
  void step(const SensorReading& reading, const NamedCommand& user);
  /// How many ticks it has made, but not in a run.
  [[nodiscard]] long ticks() const { return ticks_; }
  /// Of the stack at the last tick, which may have been another one.
  [[nodiscard]] StackNames names() const {
    return has_other_stack() ? *before_ : StackNames{(*this)->level_names(), (*this)->row_names()};
  }
  /// Has another stack come since the last tick?
  [[nodiscard]] bool has_other_stack() const { return before_.has_value(); }
  /// As Lent's: a tick of the run follows.
  void resume() {
    Lent::resume();
    before_.reset();
  }
  /// As the controller's; keeps the names of the last tick.
  [[nodiscard]] bool set_stack(const control::StackOptions& stack, double duration);
  /// A command with its gait found. Throws Error on NaN and on a gait that is not the scenario's.
  [[nodiscard]] UserCommand checked(const NamedCommand& user) const;
  /// What a part of the user's own did wrong, when it does so first.
  [[nodiscard]] std::string new_fault() {
    std::string fault = (*this)->fault();
    if (fault == told_) return {};
    return told_ = fault;
  }
  /// Of the last tick; in a run it is not known.
  [[nodiscard]] TickTiming timing() const {
    if (!timer_) return {};
    TickTiming timing = timer_->timing();
    timing.time = (**this).record().reading.time;
    return timing;
  }

  Changes changes;

 private:
  /// Throws Error on a reading of another robot.
  void check(const SensorReading& reading) const;
  [[nodiscard]] static std::vector<std::string> gaits_of(const config::Scenario& scenario);

  model::RobotDescription robot_;
  mutable std::shared_ptr<Robot> shared_robot_;
  std::string options_;
  std::vector<std::string> gaits_;
  std::unique_ptr<runtime::StageTimer> timer_;
  std::string told_;
  long ticks_ = 0;
  std::optional<StackNames> before_;  // of the stack at the last tick, if another has come since
};

}  // namespace surefoot::python
