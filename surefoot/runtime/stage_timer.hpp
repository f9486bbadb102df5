#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <array>
#include <chrono>

namespace surefoot::runtime {

/// The controller's `level_times` [s] for a TickTiming [µs]; 0 becomes NaN.
[[nodiscard]] LevelTimes in_microseconds(const std::array<double, kMaxLevels>& seconds) noexcept;

/// Measures the stages of the controller's tick with a steady clock. Allocates nothing.
class StageTimer final : public control::StageObserver {
 public:
  void tick_begins() noexcept override;
  void stage_ends(control::Stage stage) noexcept override;

  /// Of the last tick [µs]; `total` covers all stages. A skipped stage took 0.
  [[nodiscard]] const TickTiming& timing() const { return timing_; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point begin_, last_;
  TickTiming timing_;
};

}  // namespace surefoot::runtime
