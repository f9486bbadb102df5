#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::estimation {

/// Checks the IMU of a robot that stands still, before any estimate uses it.
///
/// The torques of stance legs at rest give the direction and size of the ground force. The
/// accelerometer must feel the same:
///
///     m f = Σ f_k,    ω = 0
///
/// in B. An IMU mounted upside down, with another unit or a wrong sign differs by the full value;
/// wrong masses, payloads and torques explain less than half of it. Legs that move, or carry less
/// than half of the robot, give no information: the last result stays.
class RestCheck {
 public:
  /// `period` of the control loop [s].
  explicit RestCheck(double period, const Scale& scale = {}, int num_legs = kNumLegs)
      : period_(period), scale_(scale), num_leg_joints_(kJointsPerLeg * num_legs) {}

  /// One tick. `force`: of the ground on all feet, by the joint torques, in B [N]; `mass` [kg].
  /// Ignores values that are not finite.
  void update(const SensorReading& reading, const JointVector& joint_velocity, const Vec3& force,
              double mass) noexcept;

  /// Duration of the IMU's fault [s]; 0: none, or unknown.
  [[nodiscard]] double wrong_for() const { return wrong_for_; }
  /// The joint torques claim that the ground pulls, so they are the faulty ones.
  [[nodiscard]] bool torques_pull() const { return torques_pull_; }

 private:
  double period_;
  Scale scale_;
  int num_leg_joints_;
  double wrong_for_ = 0.0;
  bool torques_pull_ = false;
};

}  // namespace surefoot::estimation
