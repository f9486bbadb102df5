#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_fields.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::replay {

/// Which state a replayed controller believes.
enum class ReplayedState {
  logged,     ///< that of the log, at every tick
  estimated,  ///< what the run's own estimator makes of the readings; logged where it was the truth
};

struct ReplayOptions {
  ReplayedState state = ReplayedState::logged;
  /// Is told of messages that no tick is made of, such as those of the truth; may be none.
  logging::LogReader::Other observer;
};

/// Ticks that are lost within a log, or at its begin. A controller can't be computed again behind
/// them: what it remembers is not known.
struct LogGap {
  std::optional<double> from;  ///< time of the last tick before [s]; none: the first ticks are lost
  double to = 0.0;             ///< time of the first tick behind [s]
  long ticks_behind = 0;       ///< that can be read, but not computed again
};

/// Whether two numbers are the same to the bit, also where they are not numbers.
[[nodiscard]] bool same_bits(double a, double b);

/// Runs a log's controller again on the logged readings, commands and states: from the first tick
/// on it computes the same bits.
class LogReplay {
 public:
  /// Throws FileError if the file is not a log of ours or lacks what its controller was made
  /// from, Error if this program can't make sense of that.
  explicit LogReplay(const std::string& path, const ReplayOptions& options = {});

  /// See `Controller::explain_levels`; a replay does unless it is told not to.
  void explain_levels(bool wanted) { controller_->explain_levels(wanted); }

  /// One tick; false after the last one, or the last before a gap. Throws FileError.
  [[nodiscard]] bool step();

  [[nodiscard]] const control::Controller& controller() const { return *controller_; }
  /// That it was made with.
  [[nodiscard]] const control::StackOptions& stack() const { return stack_; }
  /// As it stands in the log.
  [[nodiscard]] const TickRecord& logged() const { return tick_; }
  [[nodiscard]] const logging::LogHeader& header() const { return log_.header(); }
  /// Whether the run's estimator runs again, too.
  [[nodiscard]] bool estimates() const { return estimates_; }
  /// After the last tick: why the log could not be read further; empty if it is whole.
  [[nodiscard]] std::string problem() const { return log_.problem(); }
  /// After the last tick: the gap that ended the replay.
  [[nodiscard]] const std::optional<LogGap>& gap() const { return gap_; }
  /// After the last tick: whether the run may have had more behind all that can be read.
  [[nodiscard]] bool may_go_on() const { return log_.may_go_on(); }
  [[nodiscard]] const logging::ClockSkips& clock_skips() const { return log_.clock_skips(); }
  /// Whether the controller gave the torques of the log at this tick, bit for bit.
  [[nodiscard]] bool is_same() const;

 private:
  void switch_levels(const LevelSwitchReport& logged);
  void apply_changes();
  void pass_over_rest();

  std::vector<logged::Change> changes_;  // that stand before the tick
  logging::LogReader log_;
  TickRecord tick_;
  std::optional<double> last_time_;  // of the ticks that were computed [s]
  std::optional<LogGap> gap_;
  bool estimates_ = false;
  std::unique_ptr<control::Controller> controller_;
  control::StackOptions stack_;
};

}  // namespace surefoot::replay
