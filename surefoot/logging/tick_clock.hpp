#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace surefoot::logging {

/// Jumps of a log's clock without a loss: the controller was not called.
struct ClockSkips {
  double begin = 0.0;           ///< time of the first tick, unless earlier ones are lost [s]
  std::uint64_t count = 0;      ///< number of jumps
  double from = 0.0, to = 0.0;  ///< tick times around the first jump [s]
};

/// Finds lost ticks by the times of a log's ticks. Ticks can be lost only in unreadable parts:
/// elsewhere the clock jumps.
class TickClock {
 public:
  /// `period` of the control loop [s]; if it is 0, nothing is found.
  explicit TickClock(double period)
      : period_(period > 0.0 ? period : std::numeric_limits<double>::quiet_NaN()) {}

  /// An unreadable part may have held ticks; `from`: time of the first one [s], if known.
  void lose(std::optional<double> from);
  /// A tick, by its time [s].
  void add(double time);
  /// Ticks should exist up to this time at the end of the log [s].
  void end(double time);

  /// No tick is lost between the last two, or before the first.
  [[nodiscard]] bool follows() const { return follows_; }
  /// Number of lost ticks before the last one; before the first one only those with known times.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] const ClockSkips& skips() const { return skips_; }

 private:
  [[nodiscard]] double expected() const { return last_ ? *last_ + period_ : begin_.value_or(0.0); }

  double period_;
  std::optional<double> last_, begin_;  // last tick; start of a loss before the first tick
  bool loses_ = false, follows_ = true;
  std::uint64_t lost_ = 0;
  ClockSkips skips_;
};

}  // namespace surefoot::logging
