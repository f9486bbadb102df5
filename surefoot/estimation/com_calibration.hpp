#pragma once

#include "surefoot/estimation/com_height.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/base_load.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot {

/// What the robot carries beyond its model and where, as standing feet feel it: payload, wrong
/// masses, and a vertical that is believed askew.
///
/// At rest the COM stands over the centre of pressure of the ground forces (GroundReaction), whose
/// F_z is m g. The means of m − m_model and of the way from the model's COM to that line,
/// forgetting what is older than a second, and how high on it the COM lies, found before, while the
/// torso turned (ComHeight), make a load of the base that fades in:
///
///     m_load = m − m_bare,   first moment in B = m c − m_bare c_bare
///
/// so that legs which move under a payload move the COM by less than they would without. Where no
/// height is known there is no mass either, and the COM moves along B's x and y alone; so it does
/// where the load is less than a hundredth of the robot and moves the COM by less than 1 cm up or
/// down, of which the weighing is not sure.
///
/// The forces are those that the joint torques leave when they have carried the legs, so links that
/// are heavier than modelled by shares s_l, as is found later, in the air, have moved them:
/// ∂f_k / ∂s_l = (J_kᵀ)⁻¹ g_l, with g_l the torques that carry link l as modelled. The COM moves
/// by ∂c / ∂s_l s_l, little by little; the mass stays: what follows is felt by the same feet. Does
/// not allocate.
class ComCalibration {
 public:
  /// `base_mass` without a load [kg] bounds what is believed.
  ComCalibration(double period, double base_mass)
      : period_(period), base_mass_(base_mass), height_(period) {}

  /// One tick: turns or weighs, as the stage says; forces in W [N]. `is_quiet`: the robot stands on
  /// all feet and nothing else moves it; ticks without are not weighed, and the turn begins anew.
  /// `dynamics` are of a model that has the load.
  void update(const Dynamics& dynamics, const PerLeg<Vec3>& foot_force, CalibrationStage stage,
              bool is_quiet) noexcept;

  /// What the links are found to weigh, from now on (LinkMassEstimator).
  void correct(const LinkMassEstimator::Shares& heavier) noexcept { heavier_ = heavier; }

  /// What the model's base carries.
  [[nodiscard]] BaseLoad load() const noexcept;
  /// Was the last weighing long enough, and had the turn before it told a height? Not before one
  /// has ended.
  [[nodiscard]] bool knows_load() const noexcept { return knows_load_; }

 private:
  using Shares = LinkMassEstimator::Shares;
  using Slope = Eigen::Matrix<double, 3, LinkMassEstimator::kNumLinks>;

  void weigh(const Dynamics& dynamics, const GroundReaction& reaction);
  void end_weighing(const Dynamics& dynamics);
  [[nodiscard]] Slope slope(const Dynamics& dynamics) const;

  double period_, base_mass_;
  bool turning_ = false, weighing_ = false, knows_load_ = false;
  ComHeight height_;
  // The weighing that goes on: by how much the model's mass and COM are off in the mean, the latter
  // from it to the line, level, in B; and the last tick in W.
  int samples_ = 0;
  double mean_mass_ = 0.0;
  Vec3 mean_offset_ = Vec3::Zero();
  Vec3 F_ = Vec3::Zero(), centre_ = Vec3::Zero();
  // What is in use, without what links weigh.
  BaseLoad before_, weighed_;
  double share_ = 1.0;           // of `weighed_`
  Slope slope_ = Slope::Zero();  // of the first moment over the links' shares [kg·m]
  Shares heavier_ = Shares::Zero(), heavier_in_use_ = Shares::Zero();
};

}  // namespace surefoot
