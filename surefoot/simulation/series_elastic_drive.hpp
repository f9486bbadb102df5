#pragma once

#include "surefoot/simulation/plant_options.hpp"

namespace surefoot::simulation {

/// Limits a motor's torque by its speed:
///
///     τ ≤ stall · clip(1 − ω/no_load, 0, 1),   τ ≥ −stall · clip(1 + ω/no_load, 0, 1)
[[nodiscard]] double limited_by_speed(double torque, double speed, double stall, double no_load);

/// The nearest multiple of the quantum inside ± limit.
[[nodiscard]] double quantised(double torque, double quantum, double limit);

/// One joint's motor, gear and spring, with all quantities at the joint's side of the gear: angle θ
/// and speed ω of the rotor, its inertia I = gear_ratio² · inertia.
///
///     τ = k (θ − q)                 spring torque, which acts on the joint
///     I ω̇ = τ_motor − τ − viscous ω − coulomb tanh(ω / coulomb_speed)
///
/// A control loop on the measured spring torque, in whole quanta, gives the motor's torque:
///
///     τ_motor = τ_ref + kp e + kp/T_i ∫ e dt − kd (ω − q̇),   e = τ_ref − [τ]
///     kp = max(0, I ω_c²/k − 1),   kd = max(0, 2 ζ ω_c I − viscous),   ω_c = 2π bandwidth
///
/// With a fixed joint τ follows τ_ref like a second-order low-pass of that bandwidth, within the
/// motor's torque–speed line. Below the spring's own frequency √(k/I)/2π (8.7 Hz on ANYmal B) kp is
/// 0: only the speed is fed back.
///
/// The implicit midpoint rule integrates rotor and spring, with a constant joint speed over the
/// step: stable for any inertia and stiffness with a prescribed joint motion, and free of
/// artificial energy.
class SeriesElasticDrive {
 public:
  SeriesElasticDrive(const ActuatorOptions& options, double timestep, Eigen::Index joint = 0);

  /// At rest under a torque [N·m], the joint at `q` [rad].
  void rest_at(double q, double torque = 0.0) noexcept;
  /// Torque of the spring with the joint at `q` [N·m].
  [[nodiscard]] double torque(double q) const noexcept { return stiffness_ * (angle_ - q); }
  /// One physics step with the reference [N·m], after which the joint is at `q` [rad].
  void advance(double reference, double q) noexcept;

 private:
  [[nodiscard]] double controlled(double reference) noexcept;
  [[nodiscard]] double friction_damping() const noexcept;

  ActuatorOptions options_;
  double timestep_, stiffness_, inertia_;
  double stall_torque_, no_load_speed_;
  double kp_, kd_;
  double angle_ = 0.0, speed_ = 0.0;              // of the rotor
  double joint_angle_ = 0.0, joint_speed_ = 0.0;  // at the end of the last step
  double integral_ = 0.0;                         // part of the motor's torque
};

}  // namespace surefoot::simulation
