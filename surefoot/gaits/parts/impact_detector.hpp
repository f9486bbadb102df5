#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/recent.hpp"

namespace surefoot::gaits {

/// Detects impacts of a swing foot. An impact changes the velocity suddenly; drives and model
/// errors change it slowly.
class ImpactDetector {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  ImpactDetector(const TouchdownOptions& options, double period, const Scale& scale = {})
      : options_(options), period_(period / scale.time()) {}

  /// A swing begins.
  void begin() {
    lags_ = {};
    mean_brake_ = 0.0;
  }
  /// One tick: has the foot's velocity just risen by more than `stopped` [m/s] while its force
  /// rose? `lag` is its velocity along the normal minus the reference's [m/s], `force` its normal
  /// force [N].
  [[nodiscard]] bool is_impact(double lag, double stopped, double force) {
    constexpr double kImpactDuration = 0.01;     // [s]
    constexpr double kForceTimeConstant = 0.05;  // [s]
    if (lags_.size() == 0) mean_force_ = force;
    mean_force_ += period_ / kForceTimeConstant * (force - mean_force_);
    const auto window =
        std::min(lags_.size(), static_cast<std::size_t>(std::ceil(kImpactDuration / period_)));
    double least = lag;
    for (std::size_t i = 0; i < window; ++i) least = std::min(least, lags_.newest(i));
    lags_.add(lag);
    return lag - least > stopped && force - mean_force_ > options_.bounce_force;
  }
  /// One tick: has the reference just left its curve, at the end of the reach or to wait for the
  /// foot? `brake` is its velocity along the normal minus the curve's [m/s]. The foot's response to
  /// such a step looks like a bounce.
  [[nodiscard]] bool is_braking(double brake) {
    constexpr double kBrakeTimeConstant = 0.04;  // until the foot follows [s]
    mean_brake_ += period_ / kBrakeTimeConstant * (brake - mean_brake_);
    return std::abs(brake - mean_brake_) > 0.5 * options_.bounce_speed;
  }

 private:
  TouchdownOptions options_;
  double period_;            // at scale 1 [s]
  Recent<double, 8> lags_;   // velocities along the normal minus the reference's [m/s]
  double mean_force_ = 0.0;  // low-pass filtered normal force [N]
  double mean_brake_ = 0.0;  // [m/s]
};

}  // namespace surefoot::gaits
