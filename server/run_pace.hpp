#pragma once

#include <chrono>

namespace surefoot::server {

/// When the ticks of a run are due, so that its time passes at a speed. A run that can't keep up
/// goes on from where it is: it does not hurry afterwards.
class RunPace {
 public:
  using Clock = std::chrono::steady_clock;

  /// From now on, by the run's time [s] at this moment; `speed` in times real time.
  void begin(double time, double speed, Clock::time_point now);
  /// When the tick at this time [s] may begin.
  [[nodiscard]] Clock::time_point due(double time, Clock::time_point now);

 private:
  double time_ = 0.0, speed_ = 1.0;
  Clock::time_point begun_{};
};

}  // namespace surefoot::server
