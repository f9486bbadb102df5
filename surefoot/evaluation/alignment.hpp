#pragma once

#include "surefoot/evaluation/start_alignment.hpp"
#include "surefoot/model/belief_frame.hpp"

#include <optional>

namespace surefoot::evaluation {

/// Pose of the simulator's world S in the controller's W: p_W = R_WS p_S + p_WS.
struct WorldPose {
  Vec3 p_WS = Vec3::Constant(kNaN);   ///< [m]
  Quat q_WS{kNaN, kNaN, kNaN, kNaN};  ///< takes S coordinates to W
};

/// How the two worlds lie at a tick, and what the truth says of plan and estimate. Errors are in
/// W; NaN: not known.
struct Alignment {
  double time = 0.0;
  WorldPose feet;   ///< by the feet that stand: plans are compared with the truth by it
  WorldPose start;  ///< as at the first tick: the estimate's drift is counted by it
  Vec2 com_error = Vec2::Constant(kNaN);  ///< true centre of mass minus the planned one [m]
  double height_error = kNaN;             ///< true height of the base minus the planned one [m]
  Vec3 base_error =
      Vec3::Constant(kNaN);     ///< estimated base minus the true one, since the start [m]
  double heading_error = kNaN;  ///< the same of its heading, to the left [rad]
};

/// Aligns the worlds tick by tick.
class Aligner {
 public:
  /// Truth and tick must be of the same time.
  const Alignment& update(const simulation::GroundTruth& truth, const TickRecord& tick);
  /// Empty: not known, or the estimate has begun anew.
  [[nodiscard]] const std::optional<StartAlignment>& start() const { return start_; }

 private:
  void compare_plan(const simulation::GroundTruth& truth, const MotionPlan& plan);
  void compare_estimate(const simulation::GroundTruth& truth, const RobotState& state);

  model::BeliefFrame frame_;
  std::optional<StartAlignment> start_;
  Alignment alignment_;
};

}  // namespace surefoot::evaluation
