#pragma once

#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <optional>

namespace surefoot {

/// Where the controller's world W lay in the true one when the run began: sensors can see neither
/// position nor heading, so a belief is counted from there.
///
///     R = R_z(yaw_true − yaw),  p = p_true − R p       at the first tick
struct StartAlignment {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
};

/// None at another tick than the run's first, whose time is 0, and where the state is not known:
/// what is counted from the start is then not known at all.
[[nodiscard]] std::optional<StartAlignment> start_alignment(const GroundTruth& truth,
                                                            const RobotState& state);

/// Does this tick's estimate begin anew? Of what was believed before nothing is counted.
[[nodiscard]] bool begins_anew(const TickRecord& tick);

/// The believed base in the true world, and how far it is off.
struct AlignedEstimate {
  Vec3 p_WB = Vec3::Constant(kNaN);   ///< [m]
  Quat q_WB{kNaN, kNaN, kNaN, kNaN};  ///< takes B coordinates to the true W
  double position_error = kNaN;       ///< |p_WB − p_WB,true| [m]
  double heading_error = kNaN;        ///< to the left [rad]
};

[[nodiscard]] AlignedEstimate aligned(const StartAlignment& start, const GroundTruth& truth,
                                      const RobotState& state);

}  // namespace surefoot
