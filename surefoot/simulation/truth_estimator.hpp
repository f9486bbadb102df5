#pragma once

#include "surefoot/estimation/state_estimator.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot {

/// `estimation: truth`: the base's pose and velocity and the joints' velocities are the simulator's
/// own, joint positions and torques come from the sensors; positions that come late by τ_q go on
/// to now, q += q̇ τ_q. The only place of control that sees the truth.
class TruthEstimator final : public StateEstimator {
 public:
  /// `truth` must outlive the estimator and belong to the time of the readings.
  explicit TruthEstimator(const GroundTruth& truth) : truth_(truth) {}

  [[nodiscard]] const RobotState& update(const SensorReading& reading,
                                         const TickContext& context) noexcept override;
  void begin_anew() noexcept override {}  // the truth has no first reading

 private:
  const GroundTruth& truth_;
  RobotState state_;
};

}  // namespace surefoot
