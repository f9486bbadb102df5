#pragma once

#include <cstddef>
#include <vector>

namespace surefoot::solver {

/// Time of each level, over all sweeps and steps of a solve. Without a clock all times are 0.
class LevelTimer {
 public:
  using Clock = double (*)();  ///< seconds of any steady clock

  LevelTimer(std::size_t num_levels, Clock clock) : clock_(clock), seconds_(num_levels, 0.0) {}

  [[nodiscard]] bool has_clock() const { return clock_ != nullptr; }
  /// Sets all times to 0.
  void reset() noexcept;
  /// Starts a level.
  void start() noexcept {
    if (clock_ != nullptr) last_ = clock_();
  }
  /// Ends this level and starts the next. Ignores levels beyond the capacity.
  void lap(int level) noexcept {
    if (clock_ != nullptr) take(level);
  }
  /// Adds time measured elsewhere.
  void add(std::size_t level, double seconds) noexcept { seconds_[level] += seconds; }
  [[nodiscard]] double seconds(std::size_t level) const { return seconds_[level]; }

  /// `lap` for kernels, which must not inline other code. Needs a clock.
  void take(int level) noexcept;

 private:
  Clock clock_;
  double last_ = 0.0;
  std::vector<double> seconds_;  // by level
};

}  // namespace surefoot::solver
