#pragma once

#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// The estimated state.
struct RobotState {
  double time = kNaN;                  ///< [s]
  Vec3 p_WB = Vec3::Constant(kNaN);    ///< base position in W [m]
  Quat q_WB{kNaN, kNaN, kNaN, kNaN};   ///< base orientation: takes B coordinates to W
  Vec3 v_WB = Vec3::Constant(kNaN);    ///< base velocity in W [m/s]
  Vec3 w_WB_B = Vec3::Constant(kNaN);  ///< base angular velocity in B [rad/s]
  /// Believed covariance of the base velocity's error in B [m²/s²], and of the orientation's as a
  /// rotation vector in W [rad²]; NaN: not estimated.
  Mat3 velocity_covariance = Mat3::Constant(kNaN);
  Mat3 orientation_covariance = Mat3::Constant(kNaN);
  JointVector q = JointVector::Constant(kNumLegJoints, kNaN);   ///< joint positions [rad]
  JointVector qd = JointVector::Constant(kNumLegJoints, kNaN);  ///< joint velocities [rad/s]
  JointVector torque =
      JointVector::Constant(kNumLegJoints, kNaN);  ///< measured joint torques [N·m]
  /// Estimated ground force on each foot, in W [N].
  PerLeg<Vec3> foot_force = per_leg<Vec3>(Vec3::Constant(kNaN));
  /// Contact point's velocity along the ground relative to the other stance feet, in W [m/s].
  PerLeg<Vec3> slip_velocity = per_leg<Vec3>(Vec3::Zero());
  PerLeg<bool> slips{};  ///< the foot is believed to slide
  /// Estimated wrench at the centre of mass, in W, besides ground and modelled payload (BaseLoad);
  /// zero within the estimate's error [N], [N·m].
  Vec3 external_force = Vec3::Zero();
  Vec3 external_moment = Vec3::Zero();

  void size_legs(int num_legs) {
    foot_force.resize(num_legs);
    slip_velocity.resize(num_legs);
    slips.resize(num_legs);
  }
  /// u = (v_WB, w_WB_B, q̇), Eq. (1).
  [[nodiscard]] GeneralizedVector u() const {
    GeneralizedVector result(6 + qd.size());
    result << v_WB, w_WB_B, qd;
    return result;
  }
  [[nodiscard]] Mat3 R_WB() const { return q_WB.toRotationMatrix(); }
};

}  // namespace surefoot
