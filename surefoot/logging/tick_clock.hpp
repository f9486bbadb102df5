#pragma once

#include <cstdint>
#include <limits>
#include <optional>

namespace surefoot {

/// Where the clock of a log does not go on by a control period from tick to tick though nothing is
/// lost: the controller was not called.
struct ClockSkips {
  double begin = 0.0;           ///< time of the first tick, unless some before it are lost [s]
  std::uint64_t count = 0;      ///< places at which it skips
  double from = 0.0, to = 0.0;  ///< times of the ticks around the first of them [s]
};

/// Tells by the times of a log's ticks which are lost. They can be only where something could not
/// be read: elsewhere it is the clock that skips.
class TickClock {
 public:
  /// `period` of the control loop [s]; where it is none, nothing is told.
  explicit TickClock(double period)
      : period_(period > 0.0 ? period : std::numeric_limits<double>::quiet_NaN()) {}

  /// Something that may have held ticks could not be read; `from`: the time of the first of them
  /// [s], where it is known.
  void lose(std::optional<double> from);
  /// A tick, by its time [s].
  void add(double time);
  /// A time up to which there would be ticks, at the end of the log [s].
  void end(double time);

  /// Nothing is lost between the last two ticks, or before the first.
  [[nodiscard]] bool follows() const { return follows_; }
  /// Ticks that are lost so far, before the last one; of those before the first one only such
  /// whose time is known.
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] const ClockSkips& skips() const { return skips_; }

 private:
  [[nodiscard]] double expected() const { return last_ ? *last_ + period_ : begin_.value_or(0.0); }

  double period_;
  std::optional<double> last_, begin_;  // last tick; before the first: of what is lost
  bool loses_ = false, follows_ = true;
  std::uint64_t lost_ = 0;
  ClockSkips skips_;
};

}  // namespace surefoot
