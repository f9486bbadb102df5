#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_fields.hpp"

#include <memory>
#include <string>
#include <vector>

namespace surefoot {

/// Runs a log's controller again on the logged readings, commands and states: from the first tick
/// on it computes the same bits.
class LogReplay {
 public:
  /// Throws FileError if the file is not a log of ours or lacks what its controller was made
  /// from, Error if this program can't make sense of that.
  explicit LogReplay(const std::string& path);

  /// See `Controller::explain_levels`; a replay does unless it is told not to.
  void explain_levels(bool wanted) { controller_->explain_levels(wanted); }

  /// One tick; false after the last whole one. Throws FileError.
  [[nodiscard]] bool step();

  [[nodiscard]] const Controller& controller() const { return *controller_; }
  /// As it stands in the log.
  [[nodiscard]] const TickRecord& logged() const { return tick_; }
  /// Whether the controller gave the torques of the log at this tick, bit for bit.
  [[nodiscard]] bool is_same() const;

 private:
  void switch_levels(const LevelSwitchReport& logged);
  void apply_changes();

  std::vector<logged::Change> changes_;  // that stand before the tick
  LogReader log_;
  TickRecord tick_;
  std::unique_ptr<Controller> controller_;
};

}  // namespace surefoot
