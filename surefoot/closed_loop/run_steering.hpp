#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/plant.hpp"

#include <functional>

namespace surefoot::closed_loop {

/// What a run is made of, for whoever steers it.
struct RunParts {
  simulation::Plant& plant;
  control::Controller& controller;
  logging::LogHeader header;  ///< also of a run without a log
  /// Keeps a change that holds from the next tick on; after one of the stack, with its names.
  std::function<void(const logged::Change&)> log_change;
};

/// What comes next.
enum class RunOrder { tick, reset, stop };

/// Steers a run between its ticks, and sees each of them: the live viewer. All calls come from the
/// run's thread.
class RunSteering {
 public:
  RunSteering() = default;
  RunSteering(const RunSteering&) = delete;
  RunSteering& operator=(const RunSteering&) = delete;
  virtual ~RunSteering() = default;

  /// The run has its parts, which live until it ends, and no tick yet.
  virtual void begin(const RunParts& parts) = 0;
  /// Before the tick at a time [s]: may wait, push, and change the controller.
  [[nodiscard]] virtual RunOrder before_tick(double time) = 0;
  /// The operator's command, or else the scenario's.
  [[nodiscard]] virtual UserCommand user(const UserCommand& planned) = 0;
  virtual void after_tick(const TickRecord& tick, const simulation::GroundTruth& truth,
                          const TickTiming& timing) = 0;
};

}  // namespace surefoot::closed_loop
