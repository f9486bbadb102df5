#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/signals/tick_record.hpp"

#include <array>
#include <chrono>

namespace surefoot {

/// What a controller's `level_times` [s] are in a TickTiming: 0 is NaN.
[[nodiscard]] LevelTimes in_microseconds(const std::array<double, kMaxLevels>& seconds) noexcept;

/// Measures the stages of the controller's tick with a steady clock. Allocates nothing.
class StageTimer final : public StageObserver {
 public:
  void tick_begins() noexcept override;
  void stage_ends(Stage stage) noexcept override;

  /// Of the last tick [µs]; `total` spans all its stages. A stage that was left out took 0.
  [[nodiscard]] const TickTiming& timing() const { return timing_; }

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point begin_, last_;
  TickTiming timing_;
};

}  // namespace surefoot
