#include "surefoot/model/leg_chain.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace surefoot::model {
namespace {

/// Frame of a hinge's child in B.
struct Frame {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();

  void follow(const Hinge& hinge, double angle) {
    p += R * hinge.p;
    R = R * hinge.R * Eigen::AngleAxisd(angle, hinge.axis).toRotationMatrix();
  }
};

/// From the hinge's axis to a point, both in the frame of the hinge's child.
Vec3 across(const Hinge& hinge, const Vec3& point) {
  return point - hinge.axis * hinge.axis.dot(point);
}

}  // namespace

Vec3 LegChain::foot_in_base(const Vec3& q, Mat3* jacobian) const noexcept {
  Frame frame;
  std::array<Vec3, kJointsPerLeg> axes;
  std::array<Vec3, kJointsPerLeg> origins;
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    frame.follow(hinges[j], q[static_cast<Eigen::Index>(j)]);
    axes[j] = frame.R * hinges[j].axis;
    origins[j] = frame.p;
  }
  const Vec3 p = frame.p + frame.R * foot;
  if (jacobian != nullptr) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      jacobian->col(static_cast<Eigen::Index>(j)) = axes[j].cross(p - origins[j]);
    }
  }
  return p;
}

double LegChain::thigh() const noexcept { return across(hinges[1], hinges[2].p).norm(); }

double LegChain::shank() const noexcept { return across(hinges[2], foot).norm(); }

Vec3 LegChain::along_thigh() const noexcept { return across(hinges[1], hinges[2].p).normalized(); }

Vec3 LegChain::along_shank() const noexcept { return across(hinges[2], foot).normalized(); }

double LegChain::knee_skew() const noexcept {
  const double cosine = hinges[1].axis.dot(hinges[2].R * hinges[2].axis);
  return std::acos(std::min(1.0, std::abs(cosine)));
}

Mat3 LegChain::shank_in_base(const Vec3& q) const noexcept {
  Frame frame;
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    frame.follow(hinges[j], q[static_cast<Eigen::Index>(j)]);
  }
  return frame.R;
}

Vec3 LegChain::hip_in_base(const Vec3& q) const noexcept {
  Frame frame;
  for (int j = 0; j <= hip_hinge; ++j) frame.follow(hinges[static_cast<std::size_t>(j)], q[j]);
  return frame.p + frame.R * hip;
}

Eigen::Matrix<double, 3, 2> LegChain::lengthening_in_base(const Vec3& q) const noexcept {
  Eigen::Matrix<double, 3, 2> result;
  Frame frame;
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    frame.follow(hinges[j], q[static_cast<Eigen::Index>(j)]);
    if (j == 1) result.col(0) = frame.R * along_thigh();
  }
  result.col(1) = frame.R * along_shank();
  return result;
}

LegChain LegChain::lengthened(double thigh, double shank) const noexcept {
  LegChain result = *this;
  result.hinges[2].p += thigh * along_thigh();
  result.foot += shank * along_shank();
  return result;
}

bool LegChain::inverse_kinematics(const Vec3& p_BF, const Vec3& guess, Vec3& q) const noexcept {
  constexpr double kTolerance = 1e-7;  // [m]
  constexpr int kMaxIterations = 200;
  constexpr double kMaxStep = 0.3;  // [rad]; keeps the knee on the guess's side
  q = guess;
  Mat3 J;
  Vec3 error = p_BF - foot_in_base(q, &J);
  double damping = 1e-6;
  for (int i = 0; i < kMaxIterations && !(error.norm() < kTolerance); ++i) {
    const Mat3 H = J.transpose() * J + damping * Mat3::Identity();
    Vec3 step = H.inverse() * (J.transpose() * error);
    const double largest = step.cwiseAbs().maxCoeff();
    if (largest > kMaxStep) step *= kMaxStep / largest;
    const Vec3 candidate = q + step;
    Mat3 candidate_J;
    const Vec3 candidate_error = p_BF - foot_in_base(candidate, &candidate_J);
    if (candidate_error.norm() < error.norm()) {
      q = candidate;
      J = candidate_J;
      error = candidate_error;
      damping = std::max(1e-12, 0.2 * damping);
    } else {
      damping *= 10.0;
      if (damping > 1e6) break;
    }
  }
  return error.norm() < kTolerance;
}

}  // namespace surefoot::model
