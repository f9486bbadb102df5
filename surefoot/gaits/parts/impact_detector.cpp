#include "surefoot/gaits/parts/impact_detector.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kJolt = 0.01;   // an impact changes a velocity within this [s]
constexpr double kUsual = 0.05;  // memory of the force on a foot in the air [s]
constexpr double kBrake = 0.04;  // a foot follows a reference that brakes at once within this [s]

}  // namespace

bool ImpactDetector::is_jolted(double lag, double stopped, double force) {
  const std::size_t most = lags_.size();
  const auto window = std::min(most, static_cast<std::size_t>(std::ceil(kJolt / period_)));
  if (num_lags_ == 0) usual_force_ = force;
  usual_force_ += period_ / kUsual * (force - usual_force_);
  double least = lag;
  for (std::size_t i = 1; i <= std::min(window, num_lags_); ++i) {
    least = std::min(least, lags_[(num_lags_ - i) % most]);
  }
  lags_[num_lags_++ % most] = lag;
  return lag - least > stopped && force - usual_force_ > options_.bounce_force;
}

// A foot falls behind a reference that steps, and comes up with it again at once: as if it bounced.
bool ImpactDetector::brakes(double brake) {
  usual_brake_ += period_ / kBrake * (brake - usual_brake_);
  return std::abs(brake - usual_brake_) > 0.5 * options_.bounce_speed;
}

}  // namespace surefoot
