#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// Turns the torso on the spot with all feet down, so that the estimator can tell the
/// accelerometer's biases, which turn along, from a tilt, which does not.
///
///     φ(t) = A w(t) sin(2π n t / T),   w(t) = (1 − cos(2π t / T)) / 2
///
/// for roll (n = 2), pitch (n = 3) and yaw (n = 1) with their amplitudes A; begins and ends at
/// rest. Before it the robot settles; after it the legs' lengths and zeros that it has found come
/// into use (KinematicCalibration), then it feels what it carries and where its centre of mass is
/// (ComCalibration).
class CalibrationMotion {
 public:
  /// From the end of the turning until the legs are believed to be as they were found, of a robot
  /// of scale 1 [s].
  static constexpr double kTakeOver = 0.7;

  /// `scale` of the robot.
  explicit CalibrationMotion(const CalibrationOptions& options, const Scale& scale = {});

  /// In which the torso can turn by the amplitudes of the options [s]: accelerations, (2π n / T)² A
  /// or somewhat more, within what legs and ground can give.
  [[nodiscard]] static double shortest_duration(const CalibrationOptions& options);

  /// From the beginning to the end of all [s]; 0 if the motion takes no time.
  [[nodiscard]] double duration() const;
  /// What is done `t` after the beginning of all [s]; nothing if the motion takes no time.
  [[nodiscard]] CalibrationStage stage(double t) const;
  /// Roll, pitch and yaw [rad], their rates and accelerations; zero where the torso does not turn.
  [[nodiscard]] Motion<Vec3> at(double t) const;

 private:
  CalibrationOptions options_;
  double take_over_, weighing_, following_;  // [s]
};

}  // namespace surefoot::gaits
