#pragma once

#include "surefoot/signals/motion_plan.hpp"

namespace surefoot {

/// Where the controller's world W lies in the true one, as its standing feet say: position and
/// heading that sensors can't see drift, so plans are compared with the truth relative to the feet.
///
///     min over yaw and p:  Σ |R_z(yaw) p_k + p − p_k,true|²     over the feet k that stand
///
/// With fewer than two standing feet, or where nothing is believed, the frame stays as it was.
class BeliefFrame {
 public:
  /// By the feet that stand as planned: where they are believed to be, and where they are [m].
  void update(const MotionPlan& plan, const PerLeg<Vec3>& believed_p_WF,
              const PerLeg<Vec3>& true_p_WF);

  /// Takes coordinates in the controller's W to the true one.
  [[nodiscard]] const Mat3& R() const { return R_; }
  [[nodiscard]] Vec3 to_truth(const Vec3& p) const { return R_ * p + p_; }

 private:
  Mat3 R_ = Mat3::Identity();
  Vec3 p_ = Vec3::Zero();
};

}  // namespace surefoot
