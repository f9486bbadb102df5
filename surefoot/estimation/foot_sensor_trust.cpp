#include "surefoot/estimation/foot_sensor_trust.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {
namespace {

constexpr double kLess = 20.0, kMore = 40.0;  // [N]
constexpr double kInTheAir = 10.0;            // more than this is a touch [N] …
constexpr double kBears = 30.0;               // … and from here on the joints know better
constexpr double kShare = 0.3;                // of the joints' force
constexpr double kPatience = 0.05;            // with one that tells more [s]
constexpr double kProof = 0.5;                // of one that was off [s]
constexpr double kRounding = 1e-9;            // [s]
constexpr double kMost = 1e4;                 // no foot bears more [N]

}  // namespace

double FootSensorTrust::force(double sensed, double by_joints) noexcept {
  if (!(std::abs(sensed) <= kMost)) {  // nor if it is NaN
    fits_for_ = 0.0;
    return by_joints;
  }
  const double error = sensed - by_joints;
  const double share = kShare * std::abs(by_joints);
  const double more = std::min(kMore, kInTheAir + std::max(0.0, by_joints));
  const bool fits = -kLess - share <= error && error <= more + share;
  off_for_ = fits ? 0.0 : off_for_ + period_;
  fits_for_ = fits ? fits_for_ + period_ : 0.0;
  if (off_for_ > kPatience + kRounding) is_trusted_ = false;
  if (fits_for_ > kProof) is_trusted_ = true;
  if (!is_trusted_ || (!fits && error < 0.0)) return by_joints;
  const double weight = std::clamp((kBears - by_joints) / (kBears - kInTheAir), 0.0, 1.0);
  return by_joints + weight * std::min(error, kMore + share);
}

}  // namespace surefoot
