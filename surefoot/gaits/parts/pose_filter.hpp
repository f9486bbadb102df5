#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/math/quintic.hpp"
#include "surefoot/math/types.hpp"

namespace surefoot::gaits {

/// A pose that goes smoothly to a target: its position and its turn from the first orientation pass
/// through a critically damped filter
///
///     r⃛ = ω³ (target − r) − 3 ω² ṙ − 3 ω r̈
///
/// with a far target brought nearer, so that they stay smooth and slow when it jumps. All in one
/// frame X.
class PoseFilter {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  PoseFilter(double period, const Scale& scale);

  void begin(const Vec3& p, const Vec3& v, const Quat& q);
  /// One tick. `orientation`: roll, pitch, yaw [rad]; NaN: as it was at first.
  void update(const Vec3& position, const Vec3& orientation) noexcept;
  /// Waits for a limb at p with q that does not follow, as where the target is out of reach: is
  /// not far from it, and goes no farther.
  void wait_for(const Vec3& p, const Quat& q) noexcept;

  [[nodiscard]] const Motion<Vec3>& position() const { return position_; }
  [[nodiscard]] Quat orientation() const;
  [[nodiscard]] const Vec3& angular_velocity() const { return turn_.v; }

 private:
  double period_, rate_, longest_, leash_;
  Motion<Vec3> position_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // [m]
  Motion<Vec3> turn_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};      // from `first_` [rad]
  Quat first_ = Quat::Identity();
};

}  // namespace surefoot::gaits
