#include "surefoot/evaluation/estimate_judge.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot {

void EstimateJudge::add(const GroundTruth& truth, const RobotState& state) {
  const Mat3 R_true = truth.q_WB.toRotationMatrix();
  const Mat3 R = state.R_WB();
  if (!R.allFinite() || !state.v_WB.allFinite() || !state.p_WB.allFinite()) return;
  const Vec3 velocity_error = R.transpose() * state.v_WB - R_true.transpose() * truth.v_WB;
  const Vec3 up = R.row(2), true_up = R_true.row(2);
  const double tilt = std::atan2(up.cross(true_up).norm(), up.dot(true_up));
  velocity_squares_ += velocity_error.squaredNorm();
  tilt_squares_ += tilt * tilt;
  tilt_max_ = ticks_ == 0 ? tilt : std::max(tilt_max_, tilt);
  true_end_ = {truth.p_WB, R_true};
  believed_end_ = {state.p_WB, R};
  if (ticks_++ > 0) return;
  true_start_ = true_end_;
  believed_start_ = believed_end_;
}

void EstimateJudge::write(Metrics& metrics) const {
  if (ticks_ == 0) return;
  const auto n = static_cast<double>(ticks_);
  metrics.velocity_error_rms_mps = std::sqrt(velocity_squares_ / n);
  metrics.tilt_error_rms_rad = std::sqrt(tilt_squares_ / n);
  metrics.tilt_error_max_rad = tilt_max_;
  const double heading = yaw(true_start_.R) - yaw(believed_start_.R);
  const Vec3 way = true_end_.p - true_start_.p;
  const Vec3 believed_way = rotation_about_z(heading) * (believed_end_.p - believed_start_.p);
  metrics.position_drift_m = (believed_way - way).norm();
  const Mat3 turned = rotation_about_z(heading) * believed_end_.R * true_end_.R.transpose();
  metrics.heading_drift_rad = std::abs(yaw(turned));
}

}  // namespace surefoot
