#pragma once

#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot::simulation {

/// `estimation: truth`: base state and joint velocities from the simulator, joint positions and
/// torques from the sensors; positions delayed by τ_q are predicted to now, q += q̇ τ_q. The only
/// part of control that knows the truth.
class TruthEstimator final : public estimation::StateEstimator {
 public:
  /// `truth` must outlive the estimator and be of the same time as the readings.
  explicit TruthEstimator(const GroundTruth& truth) : truth_(truth) {}

  [[nodiscard]] const RobotState& update(const SensorReading& reading,
                                         const TickContext& context) noexcept override;
  void restart() noexcept override {}  // the truth has no first reading
  bool is_own() const noexcept override { return false; }

 private:
  const GroundTruth& truth_;
  RobotState state_;
};

}  // namespace surefoot::simulation
