#pragma once

#include "surefoot/estimation/com_height.hpp"
#include "surefoot/estimation/link_mass_estimator.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/base_load.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::estimation {

/// Estimates the payload of a standing robot, mass and place, from its foot forces; also covers
/// wrong link masses and an inclined vertical.
///
/// At rest the COM is above the centre of pressure of the ground forces (GroundReaction), and F_z
/// is m g. The weighing averages m − m_model and the offset from the model's COM to that line, with
/// a memory of a second (at scale 1). The turn before it gives the COM's height on the line
/// (ComHeight). The result fades in as a load of the base:
///
///     m_load = m − m_bare,   first moment in B = m c − m_bare c_bare
///
/// so that moving legs move the COM of a loaded robot by less. Without a height the mass is unknown
/// too, and the COM moves along B's x and y alone. The same holds for a load that is too small to
/// be certain: under a hundredth of the robot, moving the COM by less than 1 cm up or down.
///
/// The forces are what the joint torques leave after carrying the legs. Links that are heavier than
/// modelled by shares s_l, known only after swings, have biased them: ∂f_k / ∂s_l = (J_kᵀ)⁻¹ g_l,
/// with g_l the torques that carry link l as modelled. So the COM follows slowly by ∂c / ∂s_l s_l;
/// the mass stays, because the same feet feel what follows. Does not allocate.
class ComCalibration {
 public:
  /// `base_mass` without a load [kg] bounds the result.
  ComCalibration(double period, double base_mass, int num_legs = kNumLegs)
      : period_(period),
        base_mass_(base_mass),
        height_(period),
        slope_(Slope::Zero(3, kJointsPerLeg * num_legs)),
        heavier_(Shares::Zero(slope_.cols())),
        heavier_in_use_(heavier_) {}

  /// One tick: turns or weighs, by stage; forces in W [N]. `is_quiet`: the robot stands on all
  /// feet, undisturbed. Other ticks are not weighed and restart the turn. `dynamics` include the
  /// load.
  void update(const model::Dynamics& dynamics, const PerLeg<Vec3>& foot_force,
              CalibrationStage stage, bool is_quiet) noexcept;

  /// Sets the links' estimated extra masses from now on (LinkMassEstimator).
  void correct(const LinkMassEstimator::Shares& heavier) noexcept { heavier_ = heavier; }

  /// Load of the model's base.
  [[nodiscard]] BaseLoad load() const noexcept;
  /// Was the last weighing long enough, with a height from the turn before? False until one has
  /// ended.
  [[nodiscard]] bool knows_load() const noexcept { return knows_load_; }

 private:
  using Shares = LinkMassEstimator::Shares;
  using Slope =
      Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, Shares::MaxRowsAtCompileTime>;

  void weigh(const model::Dynamics& dynamics, const GroundReaction& reaction);
  void end_weighing(const model::Dynamics& dynamics);
  [[nodiscard]] Slope slope(const model::Dynamics& dynamics) const;

  double period_, base_mass_;
  bool turning_ = false, weighing_ = false, knows_load_ = false;
  ComHeight height_;
  // The current weighing: mean errors of the model's mass and COM (horizontal, in B); the last tick
  // in W.
  int samples_ = 0;
  double mean_mass_ = 0.0;
  Vec3 mean_offset_ = Vec3::Zero();
  Vec3 F_ = Vec3::Zero(), centre_ = Vec3::Zero();
  // The result in use, without the links' masses.
  BaseLoad before_, weighed_;
  double share_ = 1.0;  // of `weighed_`
  Slope slope_;         // of the first moment over the links' shares [kg·m]
  Shares heavier_, heavier_in_use_;
};

}  // namespace surefoot::estimation
