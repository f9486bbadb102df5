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

  /// One tick. `command` is of the tick before, NaN where none was followed; `state` has the
  /// torques and foot forces of this one.
  void update(const RobotState& state, const Dynamics& dynamics, const PerLeg<bool>& stands,
              const JointVector& command) noexcept;
  /// Nothing is known of this tick.
  void forget() noexcept;

  /// False where a torque is not what was commanded, or all claim too much.
  [[nodiscard]] bool is_well() const { return !(error_share() > 1.0) && !(claim_share() > 1.0); }
  /// The only joint whose torque is not what was commanded; −1: none, or several.
  [[nodiscard]] int joint() const;
  /// The largest error, and the largest claim, as shares of what is allowed.
  [[nodiscard]] double error_share() const;
  [[nodiscard]] double claim_share() const;
  [[nodiscard]] double time_constant() const { return options_.time_constant; }
  [[nodiscard]] const JointVector& error() const { return error_; }
  [[nodiscard]] const ExternalForceEstimator& claim() const { return claim_; }

 private:
  TorqueCheckOptions options_;
  double gain_;
  JointVector error_ = JointVector::Zero();  // low-passed [N·m]
  ExternalForceEstimator claim_;
};

}  // namespace surefoot
