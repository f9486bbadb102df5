#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// Turns the torso on the spot with all feet down. The accelerometer's biases turn with the torso
/// and gravity does not, so the estimator can separate biases from tilt.
///
///     φ(t) = A w(t) sin(2π n t / T),   w(t) = (1 − cos(2π t / T)) / 2
///
/// for roll (n = 2), pitch (n = 3) and yaw (n = 1) with their amplitudes A; begins and ends at
/// rest. Before it the robot settles. After it the estimated leg lengths and joint zeros come into
/// use (KinematicCalibration), then payload and centre of mass are estimated (ComCalibration).
class CalibrationMotion {
 public:
  /// From the end of the turning until the estimated leg lengths and zeros are in use, of a robot
  /// of scale 1 [s].
  static constexpr double kTakeOver = 0.7;

  /// `scale` of the robot.
  explicit CalibrationMotion(const CalibrationOptions& options, const Scale& scale = {});

  /// Shortest duration in which legs and ground can turn the torso by the options' amplitudes [s]:
  /// accelerations are about (2π n / T)² A.
  [[nodiscard]] static double shortest_duration(const CalibrationOptions& options,
                                                const Scale& scale = {});

  /// From the beginning of the first stage to the end of the last [s]; 0 without a motion.
  [[nodiscard]] double duration() const;
  /// Stage at `t` after the beginning [s]; none without a motion.
  [[nodiscard]] CalibrationStage stage(double t) const;
  /// Roll, pitch and yaw [rad], their rates and accelerations; zero in other stages.
  [[nodiscard]] Motion<Vec3> at(double t) const;

 private:
  CalibrationOptions options_;
  double take_over_, weighing_, following_;  // [s]
};

}  // namespace surefoot::gaits
