#include "surefoot/evaluation/estimate_judge.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace surefoot::evaluation {
namespace {

/// eᵀ P⁻¹ e, a degree of freedom; NaN where P is not positive definite.
template <int size>
double normalized(const Eigen::Vector<double, size>& e,
                  const Eigen::Matrix<double, size, size>& P) {
  const Eigen::LLT<Eigen::Matrix<double, size, size>> factor(P);
  if (factor.info() != Eigen::Success) return kNaN;
  return e.dot(factor.solve(e)) / size;
}

}  // namespace

void Nees::add(double value) {
  if (std::isnan(value)) return;
  sum_ += value;
  ++count_;
}

double Nees::mean() const { return count_ == 0 ? kNaN : sum_ / static_cast<double>(count_); }

void EstimateJudge::add(const simulation::GroundTruth& truth, const RobotState& state) {
  const Mat3 R_true = truth.q_SB.toRotationMatrix();
  const Mat3 R = state.R_WB();
  if (!R.allFinite() || !state.v_WB.allFinite() || !state.p_WB.allFinite()) return;
  const Vec3 velocity_error = R.transpose() * state.v_WB - R_true.transpose() * truth.v_SB;
  const Vec3 up = R.row(2), true_up = R_true.row(2);
  const double tilt = std::atan2(up.cross(true_up).norm(), up.dot(true_up));
  velocity_squares_ += velocity_error.squaredNorm();
  tilt_squares_ += tilt * tilt;
  tilt_max_ = ticks_ == 0 ? tilt : std::max(tilt_max_, tilt);
  ++ticks_;
  velocity_nees_.add(normalized<3>(velocity_error, state.velocity_covariance));
  const Vec3 true_up_in_W = R * true_up;
  tilt_nees_.add(normalized<2>({-true_up_in_W.y(), true_up_in_W.x()},
                               state.orientation_covariance.topLeftCorner<2, 2>()));
  if (!start_) start_ = start_alignment(truth, state);
  if (start_) end_ = aligned(*start_, truth, state);
}

void EstimateJudge::write(Metrics& metrics) const {
  if (ticks_ == 0) return;
  const auto n = static_cast<double>(ticks_);
  metrics.velocity_error_rms_mps = std::sqrt(velocity_squares_ / n);
  metrics.tilt_error_rms_rad = std::sqrt(tilt_squares_ / n);
  metrics.tilt_error_max_rad = tilt_max_;
  metrics.velocity_nees = velocity_nees_.mean();
  metrics.tilt_nees = tilt_nees_.mean();
  metrics.position_drift_m = end_.position_error;
  metrics.heading_drift_rad = std::abs(end_.heading_error);
}

}  // namespace surefoot::evaluation
