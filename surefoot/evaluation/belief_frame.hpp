#pragma once

#include "surefoot/signals/tick_record.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot {

/// Where the controller's world W lies in the true one, as its standing feet say: position and
/// heading that sensors can't see drift, so plans are compared with the truth relative to the feet.
///
///     min over yaw and p:  Σ |R_z(yaw) p_k + p − p_k,true|²     over the feet k that stand
///
/// With fewer than two standing feet the frame stays as it was.
class BeliefFrame {
 public:
  void update(const GroundTruth& truth, const TickRecord& tick);

  /// Takes coordinates in the controller's W to the true one.
  [[nodiscard]] const Mat3& R() const { return R_; }
  [[nodiscard]] Vec3 to_truth(const Vec3& p) const { return R_ * p + p_; }

 private:
  Mat3 R_ = Mat3::Identity();
  Vec3 p_ = Vec3::Zero();
};

}  // namespace surefoot
