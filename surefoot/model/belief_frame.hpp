#pragma once

#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::model {

/// Pose of the controller's world W in the simulator's S, fitted to the stance feet. The
/// estimate drifts in position and heading, so plans are compared with the truth relative to the
/// feet.
///
///     min over yaw and p:  Σ |R_z(yaw) p_k,W + p − p_k,S|²     over the feet k that stand
///
/// With fewer than two stance feet, or without an estimate, the frame keeps its value.
class BeliefFrame {
 public:
  /// Uses the feet that stand as planned, at their estimated and true positions [m].
  void update(const MotionPlan& plan, const PerLeg<Vec3>& p_WF, const PerLeg<Vec3>& p_SF);

  /// Takes coordinates from W to S.
  [[nodiscard]] const Mat3& R_SW() const { return R_SW_; }
  [[nodiscard]] Vec3 to_S(const Vec3& p) const { return R_SW_ * p + p_SW_; }

 private:
  Mat3 R_SW_ = Mat3::Identity();
  Vec3 p_SW_ = Vec3::Zero();
};

}  // namespace surefoot::model
