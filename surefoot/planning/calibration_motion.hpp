#pragma once

#include "surefoot/math/quintic.hpp"
#include "surefoot/planning/planner_options.hpp"

namespace surefoot {

/// Turns the torso on the spot with all feet down, so that the estimator can tell the
/// accelerometer's biases, which turn along, from a tilt, which does not.
///
///     φ(t) = A w(t) sin(2π n t / T),   w(t) = (1 − cos(2π t / T)) / 2
///
/// for roll (n = 2), pitch (n = 3) and yaw (n = 1) with their amplitudes A; begins and ends at
/// rest.
class CalibrationMotion {
 public:
  explicit CalibrationMotion(const CalibrationOptions& options) : options_(options) {}

  [[nodiscard]] double duration() const { return options_.duration; }
  /// Roll, pitch and yaw [rad], their rates and accelerations, `t` after the beginning [s]; zero
  /// outside of [0, T].
  [[nodiscard]] Motion<Vec3> at(double t) const;

 private:
  CalibrationOptions options_;
};

}  // namespace surefoot
