#pragma once

#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Whether the IMU fits a robot that stands still, before anything is estimated with it.
///
/// Of legs that bear the robot and don't move the torques say which way is up, and how hard the
/// ground pushes. An accelerometer feels the same:
///
///     m f = Σ f_k,    ω = 0
///
/// in B. An IMU that is mounted upside down, gives another unit or has a wrong sign is off by as
/// much as there is; wrong masses, payloads and torques explain less than half of it. Legs that
/// bear less than half of the robot, or move, say nothing: what was found before stands.
class RestCheck {
 public:
  /// `period` of the control loop [s].
  explicit RestCheck(double period) : period_(period) {}

  /// One tick. `force`: of the ground on the feet all together, by the joint torques, in B [N];
  /// `mass` [kg]. What is not finite says nothing.
  void update(const SensorReading& reading, const JointVector& joint_velocity, const Vec3& force,
              double mass) noexcept;

  /// How long the IMU has been wrong for [s]; 0: it is not, or nothing is known.
  [[nodiscard]] double wrong_for() const { return wrong_for_; }
  /// By the joint torques the ground pulls, so it is they that are wrong.
  [[nodiscard]] bool torques_pull() const { return torques_pull_; }

 private:
  double period_;
  double wrong_for_ = 0.0;
  bool torques_pull_ = false;
};

}  // namespace surefoot
