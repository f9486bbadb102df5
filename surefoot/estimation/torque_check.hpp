#pragma once

#include "surefoot/estimation/external_force.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"

namespace surefoot {

/// Holds the joint torques against what was commanded, which drives follow but for delay, lag and
/// gain, and against what can push or load the robot: a momentum observer on the whole body
/// (`ExternalForceEstimator`) tells what they claim. What claims as much with the commanded torques
/// in the place of the measured ones is no fault of sensors, but a blow, or a robot that has come
/// down on its belly. Does not allocate.
class TorqueCheck {
 public:
  TorqueCheck(const TorqueCheckOptions& options, double period);

  /// One tick. `command` is of the tick before; `state` has the torques and foot forces of this
  /// one. `moves_exactly`: from encoders with a new sample; coarser ones claim what they like.
  void update(const RobotState& state, const Dynamics& dynamics, const PerLeg<bool>& stands,
              const JointVector& command, bool moves_exactly) noexcept;
  /// Nothing is known of this tick.
  void forget() noexcept;

  /// For how long torques have been wrong: those of joints that were not what was commanded, or
  /// all, which claim too much [s]; 0: they are not.
  [[nodiscard]] double wrong_for() const;
  /// The only joint whose torque was not what was commanded; −1: none, or several.
  [[nodiscard]] int joint() const;

 private:
  /// A force and a moment about the centre of mass, in W.
  struct Wrench {
    Vec3 force = Vec3::Zero();   // [N]
    Vec3 moment = Vec3::Zero();  // [N·m]
  };

  [[nodiscard]] Wrench claimed_by_errors(const Dynamics& dynamics,
                                         const PerLeg<bool>& stands) const;
  [[nodiscard]] bool claims_too_much() const;

  TorqueCheckOptions options_;
  double period_, gain_, claim_gain_;
  JointVector error_ = JointVector::Zero(), off_for_ = JointVector::Zero();  // [N·m], [s]
  ExternalForceEstimator claim_;
  Wrench by_errors_;                           // of it
  double exact_for_ = 0.0, claims_for_ = 0.0;  // [s]
};

}  // namespace surefoot
