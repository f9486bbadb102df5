#pragma once

#include <chrono>

namespace surefoot::server {

/// Computes when ticks are due at a speed. A run that can't keep up does not hurry afterwards.
class RunPace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Starts the pace now, at the run's time [s]; `speed` relative to real time.
  void begin(double time, double speed, Clock::time_point now);
  /// When the tick at this time [s] may begin.
  [[nodiscard]] Clock::time_point due(double time, Clock::time_point now);

 private:
  double time_ = 0.0, speed_ = 1.0;
  Clock::time_point begun_{};
};

}  // namespace surefoot::server
