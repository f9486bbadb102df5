#pragma once

#include "surefoot/estimation/external_force.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"

namespace surefoot {

/// Holds the joint torques against what was commanded, which drives follow but for delay, lag and
/// gain, and against what can push or load the robot: a momentum observer on the whole body
/// (`ExternalForceEstimator`) tells what they claim. Does not allocate.
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
  TorqueCheckOptions options_;
  double period_, gain_;
  JointVector error_ = JointVector::Zero(), off_for_ = JointVector::Zero();  // [N·m], [s]
  ExternalForceEstimator claim_;
  double exact_for_ = 0.0, claims_for_ = 0.0;  // [s]
};

}  // namespace surefoot
