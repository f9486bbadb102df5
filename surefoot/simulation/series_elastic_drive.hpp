#pragma once

#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Largest and smallest torque that a motor gives at a speed:
///
///     τ ≤ stall · clip(1 − ω/no_load, 0, 1),   τ ≥ −stall · clip(1 + ω/no_load, 0, 1)
[[nodiscard]] double limited_by_speed(double torque, double speed, const ActuatorOptions& options);

/// The nearest multiple of the quantum inside ± limit.
[[nodiscard]] double quantised(double torque, double quantum, double limit);

/// One joint's motor, gear and spring. Everything is told at the joint's side of the gear: angle θ
/// and speed ω of the rotor, its inertia I = gear_ratio² · inertia.
///
///     τ = k (θ − q)                 of the spring, which the joint feels
///     I ω̇ = τ_motor − τ − viscous ω − coulomb tanh(ω / coulomb_speed)
///
/// The motor's torque comes from a loop on the spring's torque as it is measured, in whole quanta:
///
///     τ_motor = τ_ref + kp e + kp/T_i ∫ e dt − kd (ω − q̇),   e = τ_ref − [τ]
///     kp = max(0, I ω_c²/k − 1),   kd = max(0, 2 ζ ω_c I − viscous),   ω_c = 2π bandwidth
///
/// so that with a held joint τ follows τ_ref like a second-order low-pass of that bandwidth, until
/// the motor's torque–speed line limits it. (Of a bandwidth below √(k/I)/2π, 8.7 Hz of ANYmal B,
/// the spring's own frequency, kp is 0: only the speed is fed back.)
///
/// Rotor and spring are integrated by the implicit midpoint rule, with the joint moving evenly over
/// the step: stable for any inertia and stiffness where the joint's motion is given, and without
/// energy of its own.
class SeriesElasticDrive {
 public:
  SeriesElasticDrive(const ActuatorOptions& options, double timestep);

  /// At rest under a torque [N·m], the joint at `q` [rad].
  void rest_at(double q, double torque = 0.0) noexcept;
  /// Torque of the spring, the joint at `q` [N·m].
  [[nodiscard]] double torque(double q) const noexcept { return stiffness_ * (angle_ - q); }
  /// One physics step with the reference [N·m], at whose end the joint has come to `q` [rad].
  void advance(double reference, double q) noexcept;

  /// Of the last step, at the joint's side [N·m].
  [[nodiscard]] double motor_torque() const noexcept { return motor_torque_; }
  [[nodiscard]] double rotor_speed() const noexcept { return speed_; }  ///< [rad/s]
  /// Of rotor and spring, the joint at `q` [J].
  [[nodiscard]] double energy(double q) const noexcept;

 private:
  [[nodiscard]] double controlled(double reference) noexcept;
  [[nodiscard]] double friction_damping() const noexcept;

  ActuatorOptions options_;
  double timestep_, stiffness_, inertia_;
  double kp_, kd_;
  double angle_ = 0.0, speed_ = 0.0;              // of the rotor
  double joint_angle_ = 0.0, joint_speed_ = 0.0;  // at the end of the last step
  double integral_ = 0.0;                         // part of the motor's torque
  double motor_torque_ = 0.0;
};

}  // namespace surefoot::simulation
