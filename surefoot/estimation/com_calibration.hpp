#pragma once

#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/model/dynamics.hpp"

namespace surefoot {

/// How far the centre of mass lies from where the model has it, as standing feet feel it: payload,
/// wrong masses, and a vertical that is believed askew.
///
/// At rest the COM stands over the centre of pressure of the ground forces f_k. With F = Σ f_k,
/// M = Σ p_k × f_k and z the height of the ground,
///
///     c_x = (z F_x − M_y) / F_z,   c_y = (z F_y + M_x) / F_z
///
/// The mean of c − c_model, forgetting what is older than a second, is the offset. It is taken to
/// be fixed in B, without a part along z, and fades in.
///
/// The forces are those that the joint torques leave when they have carried the legs, so links that
/// are heavier than modelled by shares s_l, as is found later, in the air, have moved them:
/// ∂f_k / ∂s_l = (J_kᵀ)⁻¹ g_l, with g_l the torques that carry link l as modelled. The offset moves
/// by ∂c / ∂s_l s_l, little by little. Does not allocate.
class ComCalibration {
 public:
  explicit ComCalibration(double period) : period_(period) {}

  /// One tick; `listening` while the robot stands still on all feet. Forces in W [N].
  void update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force, bool listening) noexcept;

  /// What the links are found to weigh, from now on (LinkMassEstimator).
  void correct(const LinkMassEstimator::Shares& heavier) noexcept { heavier_ = heavier; }

  /// To be added to the model's COM, in B [m].
  [[nodiscard]] Vec3 offset() const noexcept;

 private:
  using Shares = LinkMassEstimator::Shares;
  using Slope = Eigen::Matrix<double, 3, LinkMassEstimator::kNumLinks>;

  [[nodiscard]] Slope slope(const Dynamics& dynamics) const;
  void end_weighing(const Dynamics& dynamics);

  double period_;
  Vec3 mean_ = Vec3::Zero();
  int samples_ = 0;
  Vec3 before_ = Vec3::Zero(), offset_ = Vec3::Zero();
  double share_ = 1.0;                             // of the offset that is in use
  Vec3 F_ = Vec3::Zero(), centre_ = Vec3::Zero();  // of the last tick weighed, in W [N], [m]
  Slope slope_ = Slope::Zero();                    // of the last weighing, in B [m]
  Shares heavier_ = Shares::Zero(), heavier_in_use_ = Shares::Zero();
};

}  // namespace surefoot
