#include "surefoot/estimation/foot_sensor_trust.hpp"

#include "surefoot/math/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kMaxDeficit = 20.0;     // of the sensor against the joints [N]
constexpr double kMaxExcess = 40.0;      // [N]
constexpr double kTouchForce = 10.0;     // of the joints: a sensor's excess at 0 N [N]
constexpr double kLoadForce = 30.0;      // from here on the joints measure better [N]
constexpr double kErrorShare = 0.3;      // of the joints' force
constexpr double kMaxExcessTime = 0.05;  // [s]
constexpr double kProofTime = 0.5;       // of fitting, after a fault [s]
constexpr double kMaxForce = 1e4;        // of a foot [N]

}  // namespace

double FootSensorTrust::force(double sensed, double by_joints) noexcept {
  if (!(std::abs(sensed) <= kMaxForce)) {  // nor if it is NaN
    fits_for_ = 0.0;
    return by_joints;
  }
  const double max_deficit = scale_.force() * kMaxDeficit;
  const double max_excess = scale_.force() * kMaxExcess;
  const double touch = scale_.force() * kTouchForce, load = scale_.force() * kLoadForce;
  const double error = sensed - by_joints;
  const double share = kErrorShare * std::abs(by_joints);
  const double more = std::min(max_excess, touch + std::max(0.0, by_joints));
  const bool fits = -max_deficit - share <= error && error <= more + share;
  off_for_ = fits ? 0.0 : off_for_ + period_;
  fits_for_ = fits ? fits_for_ + period_ : 0.0;
  if (off_for_ > kMaxExcessTime + kTimeRounding) is_trusted_ = false;
  if (fits_for_ > kProofTime) is_trusted_ = true;
  if (!is_trusted_ || (!fits && error < 0.0)) return by_joints;
  const double weight = std::clamp((load - by_joints) / (load - touch), 0.0, 1.0);
  return by_joints + weight * std::min(error, max_excess + share);
}

}  // namespace surefoot::estimation
