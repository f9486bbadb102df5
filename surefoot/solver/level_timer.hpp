#pragma once

#include <cstddef>
#include <vector>

namespace surefoot {

/// How long each level takes, over all sweeps and steps of a solve. Without a clock nothing is
/// read, and all times are 0.
class LevelTimer {
 public:
  using Clock = double (*)();  ///< seconds of any steady clock

  LevelTimer(std::size_t num_levels, Clock clock) : clock_(clock), seconds_(num_levels, 0.0) {}

  [[nodiscard]] bool has_clock() const { return clock_ != nullptr; }
  /// All times are 0.
  void reset() noexcept;
  /// What follows belongs to a level …
  void start() noexcept {
    if (clock_ != nullptr) last_ = clock_();
  }
  /// … which ends here; what follows belongs to the next one. Of levels that it has no room for
  /// nothing is kept.
  void lap(int level) noexcept {
    if (clock_ != nullptr) take(level);
  }
  /// What others have measured.
  void add(std::size_t level, double seconds) noexcept { seconds_[level] += seconds; }
  [[nodiscard]] double seconds(std::size_t level) const { return seconds_[level]; }

  /// `lap` for kernels, into whose code nothing is inlined. There must be a clock.
  void take(int level) noexcept;

 private:
  Clock clock_;
  double last_ = 0.0;
  std::vector<double> seconds_;  // by level
};

}  // namespace surefoot
