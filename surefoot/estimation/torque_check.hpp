#pragma once

#include "surefoot/estimation/external_force.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"

namespace surefoot::estimation {

/// Checks the joint torques against the command, which drives follow with delay, lag and gain, and
/// against plausible pushes and loads: a momentum observer on the whole body
/// (`ExternalForceEstimator`) gives the force that they claim. If the commanded torques claim as
/// much, it is no sensor fault, but an impact, or a robot lying on its torso. Does not allocate.
class TorqueCheck {
 public:
  TorqueCheck(const TorqueCheckOptions& options, double period, int num_joints = kNumLegJoints);

  /// One tick. `command` is of the tick before; `state` has the torques and foot forces of this
  /// one. `moves_exactly`: the encoders have a new sample; without it claims are not judged.
  void update(const RobotState& state, const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              const JointVector& command, bool moves_exactly) noexcept;
  /// This tick gives no information.
  void forget() noexcept;

  /// Duration of a fault: of joints that contradict their command, or of all, which
  /// claim too much [s]; 0: none.
  [[nodiscard]] double wrong_for() const;
  /// The only joint that contradicts its command; −1: none, or several.
  [[nodiscard]] int joint() const;

 private:
  /// A force and a moment about the centre of mass, in W.
  struct Wrench {
    Vec3 force = Vec3::Zero();   // [N]
    Vec3 moment = Vec3::Zero();  // [N·m]
  };

  [[nodiscard]] Wrench claimed_by_errors(const model::Dynamics& dynamics,
                                         const PerLeg<bool>& stands) const;
  [[nodiscard]] bool claims_too_much() const;

  TorqueCheckOptions options_;
  double period_, gain_, claim_gain_;
  JointVector error_, off_for_;  // [N·m], [s]
  ExternalForceEstimator claim_;
  Wrench by_errors_;                           // share of the claim from torque errors
  double exact_for_ = 0.0, claims_for_ = 0.0;  // [s]
};

}  // namespace surefoot::estimation
