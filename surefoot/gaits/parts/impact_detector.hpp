#pragma once

#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/recent.hpp"

namespace surefoot::gaits {

/// Tells a swinging foot that hits something, whose velocity changes at once, from one whose drives
/// and model change it little by little.
class ImpactDetector {
 public:
  /// `period` of the control loop [s].
  ImpactDetector(const TouchdownOptions& options, double period)
      : options_(options), period_(period) {}

  /// A swing begins.
  void begin() {
    lags_ = {};
    usual_brake_ = 0.0;
  }
  /// One tick: has the foot's velocity just changed by `stopped`, as by an impact, and does
  /// something bear it? `lag` is that velocity along the normal, less its reference's [m/s];
  /// `force` is along it, too [N].
  [[nodiscard]] bool is_jolted(double lag, double stopped, double force) {
    constexpr double kJolt = 0.01;   // an impact changes a velocity within this [s]
    constexpr double kUsual = 0.05;  // memory of the force on a foot in the air [s]
    if (lags_.size() == 0) usual_force_ = force;
    usual_force_ += period_ / kUsual * (force - usual_force_);
    const auto window =
        std::min(lags_.size(), static_cast<std::size_t>(std::ceil(kJolt / period_)));
    double least = lag;
    for (std::size_t i = 0; i < window; ++i) least = std::min(least, lags_.newest(i));
    lags_.add(lag);
    return lag - least > stopped && force - usual_force_ > options_.bounce_force;
  }
  /// One tick: does the reference leave its curve just now, at the end of the reach, or to wait for
  /// the foot? `brake`: its velocity along the normal, less the curve's [m/s]. A foot falls behind
  /// a reference that steps, and comes up with it again at once: as if it bounced.
  [[nodiscard]] bool brakes(double brake) {
    constexpr double kBrake = 0.04;  // a foot follows a reference that brakes within this [s]
    usual_brake_ += period_ / kBrake * (brake - usual_brake_);
    return std::abs(brake - usual_brake_) > 0.5 * options_.bounce_speed;
  }

 private:
  TouchdownOptions options_;
  double period_;
  Recent<double, 8> lags_;    // how much faster than its reference the foot was [m/s]
  double usual_force_ = 0.0;  // on a swinging foot, as estimated [N]
  double usual_brake_ = 0.0;  // [m/s]
};

}  // namespace surefoot::gaits
