#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

struct ContactForceOptions {
  double cutoff_hz = 40.0;  ///< low-pass of the generalized residual
  /// Take the normal force of a foot force sensor instead, where there is one.
  bool use_foot_sensor = false;
};

/// Ground forces on the feet from joint torques alone, without foot sensors:
///
///     f_k = (J_kᵀ)⁻¹ LPF(M Δu/Δt + h − Sᵀτ)_k      (rows and columns of leg k; from Eq. 2)
///
/// Δt are the whole periods since the last update: ticks that were left out count. J_k is the 3×3
/// block of the contact Jacobian of leg k, inverted with a damping that matters only near the
/// straight leg. In W, of the ground on the foot [N]. Does not allocate.
class ContactForceEstimator {
 public:
  ContactForceEstimator(const ContactForceOptions& options, double period);

  /// Fills state.foot_force from state.torque and the dynamics at that state. `terrain_normal_W` is
  /// the unit normal as believed: a foot sensor gives the force along it.
  void update(const Dynamics& dynamics, const Vec3& terrain_normal_W, const SensorReading& reading,
              RobotState& state) noexcept;

 private:
  ContactForceOptions options_;
  double period_;
  double decay_;                 ///< of the low-pass in one period
  double previous_time_ = kNaN;  ///< [s]
  GeneralizedVector previous_u_ = GeneralizedVector::Zero();
  JointVector residual_ = JointVector::Zero();
  bool initialised_ = false;
};

}  // namespace surefoot
