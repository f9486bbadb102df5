#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <optional>

namespace surefoot::evaluation {

/// Pose of the controller's world W in the simulator's S at the start of the run. Sensors can see
/// neither position nor heading, so estimates are compared relative to it.
///
///     R_SW = R_z(yaw_S − yaw_W),  p_SW = p_SB − R_SW p_WB       at the first tick
struct StartAlignment {
  Mat3 R_SW = Mat3::Identity();
  Vec3 p_SW = Vec3::Zero();
};

/// Empty at any tick but the run's first, whose time is 0, or without an estimate: values relative
/// to the start are unknown then.
[[nodiscard]] std::optional<StartAlignment> start_alignment(const simulation::GroundTruth& truth,
                                                            const RobotState& state);

/// Does the estimate restart at this tick, so that the past does not count?
[[nodiscard]] bool estimate_restarts(const TickRecord& tick);

/// The estimated base in the simulator's world S, and its error.
struct AlignedEstimate {
  Vec3 p_SB = Vec3::Constant(kNaN);   ///< [m]
  Quat q_SB{kNaN, kNaN, kNaN, kNaN};  ///< takes B coordinates to S
  double position_error = kNaN;       ///< against the true one [m]
  double heading_error = kNaN;        ///< to the left [rad]
};

[[nodiscard]] AlignedEstimate aligned(const StartAlignment& start,
                                      const simulation::GroundTruth& truth,
                                      const RobotState& state);

}  // namespace surefoot::evaluation
