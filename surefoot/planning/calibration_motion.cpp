#include "surefoot/planning/calibration_motion.hpp"

#include <cmath>

namespace surefoot {
namespace {

constexpr double kTakeOver = 0.7;   // until the legs are believed to be as they were found [s]
constexpr double kWeighing = 1.3;   // [s]
constexpr double kFollowing = 1.0;  // until the COM is where it is now known to belong [s]

Motion<double> sine(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {s, frequency * c, -frequency * frequency * s};
}

Motion<double> window(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {0.5 * (1.0 - c), 0.5 * frequency * s, 0.5 * frequency * frequency * c};
}

}  // namespace

CalibrationStage CalibrationMotion::stage(double t) const {
  if (!(options_.duration > 0.0)) return CalibrationStage::none;
  const double since_turning = t - options_.settle - options_.duration;
  if (t < options_.settle) return CalibrationStage::settling;
  if (since_turning < 0.0) return CalibrationStage::turning;
  if (since_turning < kTakeOver) return CalibrationStage::settling;
  if (since_turning < kTakeOver + kWeighing) return CalibrationStage::weighing;
  const bool follows = since_turning < kTakeOver + kWeighing + kFollowing;
  return follows ? CalibrationStage::settling : CalibrationStage::none;
}

Motion<Vec3> CalibrationMotion::at(double since_beginning) const {
  Motion<Vec3> result{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  const double t = since_beginning - options_.settle;
  if (!(t > 0.0 && t < options_.duration)) return result;
  const double once = 2.0 * kPi / options_.duration;
  const Vec3 amplitudes(options_.roll, options_.pitch, options_.yaw);
  const Vec3 periods(2.0, 3.0, 1.0);
  const Motion<double> w = window(once, t);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Motion<double> s = sine(periods[i] * once, t);
    result.p[i] = amplitudes[i] * w.p * s.p;
    result.v[i] = amplitudes[i] * (w.v * s.p + w.p * s.v);
    result.a[i] = amplitudes[i] * (w.a * s.p + 2.0 * w.v * s.v + w.p * s.a);
  }
  return result;
}

}  // namespace surefoot
