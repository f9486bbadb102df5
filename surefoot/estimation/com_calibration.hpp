#pragma once

#include "surefoot/estimation/com_height.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/model/base_load.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot {

/// What the robot carries beyond its model and where, as standing feet feel it: payload, wrong
/// masses, and a vertical that is believed askew.
///
/// At rest the COM stands over the centre of pressure of the ground forces f_k, of which m = F_z /
/// g are felt (GroundReaction). The means of m − m_model and c − c_model, forgetting what is older
/// than a second, fade in. How high the COM lies is found before, while the torso turns
/// (ComHeight). Both are taken for a load of the base, with mass m − m_model and first moment m c −
/// m_model c_model in B: legs that move under a payload move the COM by less than they would
/// without.
///
/// The forces are those that the joint torques leave when they have carried the legs, so links that
/// are heavier than modelled by shares s_l, as is found later, in the air, have moved them:
/// ∂f_k / ∂s_l = (J_kᵀ)⁻¹ g_l, with g_l the torques that carry link l as modelled. The COM moves
/// by ∂c / ∂s_l s_l, little by little. Does not allocate.
class ComCalibration {
 public:
  explicit ComCalibration(double period) : period_(period) {}

  /// One tick: turns or weighs with the robot on all feet, as the stage says; forces in W [N].
  /// Ticks of these stages may be missed. `dynamics` are of a model that has the load.
  void update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
              CalibrationStage stage) noexcept;

  /// What the links are found to weigh, from now on (LinkMassEstimator).
  void correct(const LinkMassEstimator::Shares& heavier) noexcept { heavier_ = heavier; }

  /// What the model's base carries.
  [[nodiscard]] BaseLoad load() const noexcept;

 private:
  using Shares = LinkMassEstimator::Shares;
  using Slope = Eigen::Matrix<double, 3, LinkMassEstimator::kNumLinks>;

  /// In the posture of the weighing.
  struct Weight {
    double mass = 0.0;           // of the load [kg]
    Vec3 offset = Vec3::Zero();  // of the COM from the bare model's, in B [m]
  };
  struct Bare {
    double mass = 0.0;        // of the model without a load [kg]
    Vec3 com = Vec3::Zero();  // in B [m]
  };

  [[nodiscard]] Slope slope(const Dynamics& dynamics) const;
  [[nodiscard]] Bare bare(const Dynamics& dynamics) const;
  [[nodiscard]] Weight in_use() const;
  void weigh(const Dynamics& dynamics, const GroundReaction& reaction);
  void end_weighing(const Dynamics& dynamics);

  double period_;
  bool turning_ = false;
  ComHeight height_;
  Weight mean_;  // by which the model's are off, and level
  int samples_ = 0;
  Weight before_, weighed_;
  Bare bare_;
  double share_ = 1.0;                             // of what was weighed that is in use
  Vec3 F_ = Vec3::Zero(), centre_ = Vec3::Zero();  // of the last tick weighed, in W [N], [m]
  Slope slope_ = Slope::Zero();                    // of the last weighing, in B [m]
  Shares heavier_ = Shares::Zero(), heavier_in_use_ = Shares::Zero();
};

}  // namespace surefoot
