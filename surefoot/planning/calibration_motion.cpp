#include "surefoot/planning/calibration_motion.hpp"

#include <cmath>

namespace surefoot {
namespace {

Motion<double> sine(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {s, frequency * c, -frequency * frequency * s};
}

Motion<double> window(double frequency, double t) {
  const double s = std::sin(frequency * t), c = std::cos(frequency * t);
  return {0.5 * (1.0 - c), 0.5 * frequency * s, 0.5 * frequency * frequency * c};
}

}  // namespace

Motion<Vec3> CalibrationMotion::at(double t) const {
  Motion<Vec3> result{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
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
