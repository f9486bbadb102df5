#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

struct ExternalForceOptions {
  bool enabled = true;
  double time_constant = 0.05, load_time_constant = 0.5;
  double dead_band = 12.0, load_dead_band = 8.0, moment_dead_band = 4.0;
  double max_force = 150.0, max_moment = 20.0;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(ExternalForceOptions& o);

/// Estimates pushes, pulls and unmodelled payload: a momentum observer on the whole body. Mass that
/// moves into the model (BaseLoad) leaves the residual at once.
///
///     d/dt (m v_com) = m g + Σ f_k + F,    d/dt L_com = Σ (p_k − c) × f_k + τ
///
/// with the ground forces f_k of the stance feet, in W. The residual r follows F as a first-order
/// low-pass, without differentiating the velocity:
///
///     r = (P − ∫ (m g + Σ f_k + r) dt) / T
///
/// Model errors look like a force, too. So a residual within the dead band counts as zero, and
/// beyond it r (1 − (band / |r|)²) is the estimate. Does not allocate.
class ExternalForceEstimator {
 public:
  explicit ExternalForceEstimator(const ExternalForceOptions& options) : options_(options) {}

  /// One tick: fills `external_force` and `external_moment` of the state, whose `foot_force` must
  /// be of this tick. `stands`: the feet planned to carry load.
  void update(const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              RobotState& state) noexcept;

  /// The residuals in W, before dead band and saturation [N], [N·m].
  [[nodiscard]] const Vec3& force() const { return force_; }
  [[nodiscard]] const Vec3& moment() const { return moment_; }

 private:
  void start(const Vec3& momentum, const Vec3& angular_momentum);
  void update_mass(const model::Dynamics& dynamics);

  ExternalForceOptions options_;
  double time_ = kNaN;  // of the last update [s]
  double mass_ = kNaN;  // of the model at that time [kg]
  Vec3 force_ = Vec3::Zero(), moment_ = Vec3::Zero();
  Vec3 explained_ = Vec3::Zero();          // momentum from known forces [N·s]
  Vec3 angular_explained_ = Vec3::Zero();  // [N·m·s]
};

}  // namespace surefoot::estimation
