#pragma once

#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::model {

/// Pose of the controller's world W in the true one, fitted to the stance feet. The estimate drifts
/// in position and heading, so plans are compared with the truth relative to the feet.
///
///     min over yaw and p:  Σ |R_z(yaw) p_k + p − p_k,true|²     over the feet k that stand
///
/// With fewer than two stance feet, or without an estimate, the frame keeps its value.
class BeliefFrame {
 public:
  /// Uses the feet that stand as planned, at their estimated and true positions [m].
  void update(const MotionPlan& plan, const PerLeg<Vec3>& believed_p_WF,
              const PerLeg<Vec3>& true_p_WF);

  /// Takes coordinates from the controller's W to the true one.
  [[nodiscard]] const Mat3& R() const { return R_; }
  [[nodiscard]] Vec3 to_truth(const Vec3& p) const { return R_ * p + p_; }

 private:
  Mat3 R_ = Mat3::Identity();
  Vec3 p_ = Vec3::Zero();
};

}  // namespace surefoot::model
