#pragma once

#include "surefoot/gaits/planner_options.hpp"

#include <array>
#include <cstddef>

namespace surefoot {

/// Tells a swinging foot that hits something, whose velocity changes at once, from one whose drives
/// and model change it little by little.
class ImpactDetector {
 public:
  /// `period` of the control loop [s].
  ImpactDetector(const TouchdownOptions& options, double period)
      : options_(options), period_(period) {}

  /// A swing begins.
  void begin() {
    num_lags_ = 0;
    usual_brake_ = 0.0;
  }
  /// One tick: has the foot's velocity just changed by `stopped`, as by an impact, and does
  /// something bear it? `lag` is that velocity along the normal, less its reference's [m/s];
  /// `force` is along it, too [N].
  [[nodiscard]] bool is_jolted(double lag, double stopped, double force);
  /// One tick: does the reference leave its curve just now, at the end of the reach, or to wait for
  /// the foot? `brake`: its velocity along the normal, less the curve's [m/s].
  [[nodiscard]] bool brakes(double brake);

 private:
  TouchdownOptions options_;
  double period_;
  /// By how much the foot was faster along the normal than its reference, at the last ticks [m/s].
  std::array<double, 8> lags_{};
  std::size_t num_lags_ = 0;
  double usual_force_ = 0.0;  // on a swinging foot, as estimated [N]
  double usual_brake_ = 0.0;  // [m/s]
};

}  // namespace surefoot
