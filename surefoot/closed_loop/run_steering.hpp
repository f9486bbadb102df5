#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/plant.hpp"

#include <functional>

namespace surefoot::closed_loop {

/// Parts of a run, for its steering.
struct RunParts {
  simulation::Plant& plant;
  control::Controller& controller;
  logging::LogHeader header;  ///< also of a run without a log
  /// Logs a change that holds from the next tick on. Call it after the change: a new stack's names
  /// are the controller's.
  std::function<void(const logged::Change&)> log_change;
};

/// What the run does next.
enum class RunOrder { tick, reset, stop };

/// Steers a run between its ticks and observes them, as the live viewer does. All calls come from
/// the run's thread.
class RunSteering {
 public:
  RunSteering() = default;
  RunSteering(const RunSteering&) = delete;
  RunSteering& operator=(const RunSteering&) = delete;
  virtual ~RunSteering() = default;

  /// Before the first tick. The parts live until the run ends.
  virtual void begin(const RunParts& parts) = 0;
  /// Before the tick at a time [s]: may wait, push, and change the controller.
  [[nodiscard]] virtual RunOrder before_tick(double time) = 0;
  /// The operator's command, or else the scenario's.
  [[nodiscard]] virtual UserCommand user(const UserCommand& planned) = 0;
  virtual void after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
                          const TickTiming& timing) = 0;
};

}  // namespace surefoot::closed_loop
