#pragma once

#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot::estimation {

/// Joint velocities and unmodelled accelerations from encoder readings alone: a steady-state Kalman
/// filter of each joint's (q, q̇, d) around the model's acceleration a.
///
///     q̈ = a + d,   ḋ = white noise
///     predict   q̂ ← q̂ + Δt q̇̂ + ½Δt² (a + d̂),   q̇̂ ← q̇̂ + Δt (a + d̂)
///     correct   e = q − q̂:   q̂ += α e,   q̇̂ += β/Δt e,   d̂ += 2γ/Δt² e
///
/// with Δt since the joint's last reading and the gains that put all three poles at θ = exp(−ω Δt):
/// α = 1 − θ³, β = 3/2 (1 − θ)² (1 + θ), γ = ½ (1 − θ)³ (fading memory; Brookner 1998, Sec. 1.3).
/// With M d as the torque, this is the generalized-momentum observer (De Luca 2003) in its Kalman
/// form (Wahrburg 2018). The model's acceleration keeps velocities free of lag. Does not
/// allocate.
class JointObserver {
 public:
  /// `bandwidth` is ω [rad/s].
  JointObserver(double bandwidth, double period, int num_joints = kNumLegJoints);

  /// At rest at q.
  void start(const JointVector& q) noexcept;
  /// Advances by `periods` ticks and takes this tick's reading. A joint with a NaN reading is only
  /// predicted; after 40 periods without any it restarts at rest with the next one.
  void update(const JointVector& q, int periods) noexcept;
  /// Shifts the state back by so many ticks, as readings are older from now on.
  void go_back(int ticks) noexcept;
  /// Sets the model's accelerations until the next reading, without unknown forces [rad/s²].
  void expect(const JointVector& acceleration) noexcept { expected_ = acceleration; }
  /// Sets the disturbance so that the joints don't accelerate now.
  void balance() noexcept { disturbance_ = -expected_; }

  [[nodiscard]] const JointVector& q() const { return q_; }
  [[nodiscard]] const JointVector& velocity() const { return velocity_; }
  /// d̂ [rad/s²].
  [[nodiscard]] const JointVector& disturbance() const { return disturbance_; }

 private:
  struct Gains {
    double q, velocity, disturbance;  // per error
  };

  [[nodiscard]] Gains gains_after(int periods) const;
  void start(Eigen::Index joint, double q) noexcept;

  double bandwidth_, period_;
  Gains each_period_;
  std::array<int, kMaxJoints> since_{};  // a joint's last reading, in periods
  JointVector q_, velocity_, disturbance_, expected_;
};

}  // namespace surefoot::estimation
