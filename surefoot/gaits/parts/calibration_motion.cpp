#include "surefoot/gaits/parts/calibration_motion.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

// Of a robot of scale 1.
constexpr double kWeighingDuration = 1.3;  // [s]
constexpr double kFollowDuration = 1.0;    // until the COM has moved to its corrected place [s]
constexpr double kMinTurnDuration = 1.0;   // [s]
constexpr double kMaxAcceleration = 36.0;  // of the torso [rad/s²]

const Vec3 kPeriods(2.0, 3.0, 1.0);  // of roll, pitch and yaw

Vec3 amplitudes_of(const CalibrationOptions& options) {
  return {options.roll, options.pitch, options.yaw};
}

Motion<double> sine(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {s, frequency * c, -frequency * frequency * s};
}

Motion<double> window(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {0.5 * (1.0 - c), 0.5 * frequency * s, 0.5 * frequency * frequency * c};
}

}  // namespace

CalibrationMotion::CalibrationMotion(const CalibrationOptions& options, const Scale& scale)
    : options_(options),
      take_over_(scale.time() * kTakeOver),
      weighing_(scale.time() * kWeighingDuration),
      following_(scale.time() * kFollowDuration) {}

double CalibrationMotion::shortest_duration(const CalibrationOptions& options, const Scale& scale) {
  const double most = amplitudes_of(options).cwiseProduct(kPeriods.cwiseAbs2()).maxCoeff();
  return scale.time() * std::max(kMinTurnDuration, 2.0 * kPi * std::sqrt(most / kMaxAcceleration));
}

double CalibrationMotion::duration() const {
  if (!(options_.duration > 0.0)) return 0.0;
  return options_.settle + options_.duration + take_over_ + weighing_ + following_;
}

CalibrationStage CalibrationMotion::stage(double t) const {
  if (!(options_.duration > 0.0)) return CalibrationStage::none;
  const double since_turning = t - options_.settle - options_.duration;
  if (t < options_.settle) return CalibrationStage::settling;
  if (since_turning < 0.0) return CalibrationStage::turning;
  if (since_turning < take_over_) return CalibrationStage::settling;
  if (since_turning < take_over_ + weighing_) return CalibrationStage::weighing;
  const bool follows = since_turning < take_over_ + weighing_ + following_;
  return follows ? CalibrationStage::settling : CalibrationStage::none;
}

Motion<Vec3> CalibrationMotion::at(double since_beginning) const {
  Motion<Vec3> result{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double t = since_beginning - options_.settle;
  if (!(t > 0.0 && t < options_.duration)) return result;
  const double once = 2.0 * kPi / options_.duration;
  const Vec3 amplitudes = amplitudes_of(options_);
  const Motion<double> w = window(once, t);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Motion<double> s = sine(kPeriods[i] * once, t);
    result.p[i] = amplitudes[i] * w.p * s.p;
    result.v[i] = amplitudes[i] * (w.v * s.p + w.p * s.v);
    result.a[i] = amplitudes[i] * (w.a * s.p + 2.0 * w.v * s.v + w.p * s.a);
  }
  return result;
}

}  // namespace surefoot::gaits
