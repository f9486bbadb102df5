#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/recorder.hpp"
#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::closed_loop {

/// A push from outside, as a change at its start.
[[nodiscard]] logged::Change push_change(const simulation::Push& push);

/// The log's channel `/changes`: what was changed from outside between two ticks.
class ChangeLog {
 public:
  /// Adds the channel; before the recorder's first tick.
  explicit ChangeLog(logging::Recorder& recorder);

  /// Writes the change before the next tick. From there on ticks have the names of the controller's
  /// present stack.
  void record(const logged::Change& change, const control::Controller& controller);

 private:
  logging::Recorder& recorder_;
  logging::Recorder::Channel channel_;
};

}  // namespace surefoot::closed_loop
