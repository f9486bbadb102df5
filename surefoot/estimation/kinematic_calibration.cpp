#include "surefoot/estimation/kinematic_calibration.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/math/smoothstep.hpp"
#include "surefoot/model/body_tree.hpp"
#include "surefoot/model/leg_jacobian.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kSampleInterval = 0.025;  // [s]
constexpr int kMinSamples = 80;
constexpr double kLongestGapInPeriods = 4.5;  // between two ticks, in periods
constexpr double kCreep = 7e-4;               // of soft feet along the ground [m]
constexpr double kSinking = 4e-4;             // of soft feet into the ground [m]
constexpr double kTurnError = 3e-4;           // σ_φ of the gyroscope's turn [rad]
constexpr double kBiasPrior = 0.03;           // standard deviation of the gyroscope's bias [rad/s]
constexpr double kLengthPrior = 6e-3;         // … of a length [m]
constexpr double kZeroPrior = 5e-3;           // … of an encoder's zero and the IMU's mounting [rad]
constexpr double kDelayPrior = 5e-3;          // … of the gyroscope's delay behind the encoders [s]
constexpr double kMaxLength = 0.02;           // limit of a length error [m]
constexpr double kMaxAngle = 0.02;            // limit of an angle error [rad]

}  // namespace

KinematicCalibration::KinematicCalibration(const model::RobotDescription& robot, double period)
    : period_(period),
      ticks_per_sample_(std::max(
          1, static_cast<int>(std::lround(robot.scale.time() * kSampleInterval / period)))),
      foot_radius_(robot.foot_radius),
      scale_(robot.scale) {
  const model::BodyTree tree = model::make_body_tree(robot, model::read_urdf(robot));
  for (const Leg leg : kLegs) chains_[index(leg)] = tree.legs[index(leg)].chain;
}

void KinematicCalibration::forget() noexcept {
  samples_ = ticks_ = 0;
  knows_legs_ = false;
  time_ = kNaN;
}

// 1 also for NaN.
double KinematicCalibration::periods_until(double time) const {
  return std::fmax(1.0, std::round((time - time_) / period_));
}

void KinematicCalibration::update(double time, const model::Dynamics& dynamics, const Vec3& gyro_B,
                                  const Vec3& normal, bool is_turning) noexcept {
  if (periods_until(time) > kLongestGapInPeriods) forget();
  const double periods = periods_until(time);
  time_ = time;
  if (!is_turning) {
    if (samples_ >= kMinSamples) finish();
    samples_ = ticks_ = 0;
    fade();
    return;
  }
  if (ticks_ == 0) start(dynamics.base_rotation.R);
  const double dt = periods * period_;
  turn(gyro_B, dt);
  for (const Leg leg : kLegs) {
    rolled_[index(leg)] += dt * dynamics.shank[index(leg)].w.cross(foot_radius_ * normal);
  }
  if (ticks_++ % ticks_per_sample_ == 0) add_sample(dynamics);
}

void KinematicCalibration::start(const Mat3& R_WB) noexcept {
  knows_legs_ = false;
  R_ = R_start_ = R_WB;
  turned_.setZero();
  rolled_.fill(Vec3::Zero());
  sum_y_.setZero();
  sum_H_.setZero();
  sum_HWH_.setZero();
  sum_HWy_.setZero();
}

void KinematicCalibration::turn(const Vec3& gyro_B, double dt) noexcept {
  if (!gyro_B.allFinite()) return;
  gyro_ = gyro_B;
  R_ = R_ * exp_rotation(dt * gyro_B).toRotationMatrix();
  turned_ += dt * R_;
}

void KinematicCalibration::add_sample(const model::Dynamics& dynamics) noexcept {
  Coordinates y;
  Sensitivity H = Sensitivity::Zero();
  const Mat3 R_from_W = R_ * dynamics.base_rotation.R.transpose();
  for (const Leg leg : kLegs) {
    const Eigen::Index k = 3 * static_cast<Eigen::Index>(index(leg));
    const Eigen::Index first = kErrorsPerLeg * static_cast<Eigen::Index>(index(leg));
    const Vec3 q = dynamics.q.segment<kJointsPerLeg>(first_joint(leg));
    const Vec3 lever = R_from_W * (dynamics.foot[index(leg)].p - dynamics.base.p);
    y.segment<3>(k) = lever - rolled_[index(leg)];
    H.block<3, 2>(k, first) = R_ * chains_[index(leg)].lengthening_in_base(q);
    H.block<3, 3>(k, first + 2) = -R_from_W * model::leg_jacobian(dynamics.foot[index(leg)], leg);
    const Vec3 f = R_.transpose() * lever;
    H.block<3, 3>(k, kImu) = R_ * skew(f) - skew(lever) * R_start_;
    H.block<3, 3>(k, kBias) = skew(lever) * turned_;
    H.block<3, 1>(k, kDelay) = R_ * gyro_.cross(f);
  }
  Vec3 mean = Vec3::Zero();
  Eigen::Matrix<double, 3, kNumErrors> mean_H = Eigen::Matrix<double, 3, kNumErrors>::Zero();
  for (int k = 0; k < kNumLegs; ++k) {
    mean += y.segment<3>(3 * k) / kNumLegs;
    mean_H += H.middleRows<3>(3 * k) / kNumLegs;
  }
  for (int k = 0; k < kNumLegs; ++k) {
    y.segment<3>(3 * k) -= mean;
    H.middleRows<3>(3 * k) -= mean_H;
  }
  if (!y.allFinite() || !H.allFinite()) return;
  if (samples_ == 0) W_ = weights(y);
  ++samples_;
  sum_y_ += y;
  sum_H_ += H;
  sum_HWH_.noalias() += H.transpose() * W_ * H;
  sum_HWy_.noalias() += H.transpose() * (W_ * y);
}

KinematicCalibration::Weights KinematicCalibration::weights(const Coordinates& y) const {
  const double creep = scale_.length * kCreep, sinking = scale_.length * kSinking;
  Eigen::Matrix<double, kNumCoordinates, 3> B;
  Coordinates variance;
  for (int k = 0; k < kNumLegs; ++k) {
    B.middleRows<3>(3 * k) = kTurnError * skew(y.segment<3>(3 * k));
    variance.segment<3>(3 * k) << creep * creep, creep * creep, sinking * sinking;
  }
  return (Weights(variance.asDiagonal()) + B * B.transpose()).inverse();
}

double KinematicCalibration::prior(int error) const {
  if (error == kDelay) return kDelayPrior;
  if (error >= kBias) return kBiasPrior;
  return is_length(error) ? scale_.length * kLengthPrior : kZeroPrior;
}

void KinematicCalibration::finish() noexcept {
  Information A = sum_HWH_ - sum_H_.transpose() * W_ * sum_H_ / samples_;
  const Errors b = sum_HWy_ - sum_H_.transpose() * (W_ * sum_y_) / samples_;
  for (int i = 0; i < kNumErrors; ++i) A(i, i) += 1.0 / (prior(i) * prior(i));
  const Errors found = -A.ldlt().solve(b);
  knows_legs_ = true;
  before_ = after_;
  share_ = 0.0;
  for (int i = 0; i < kBias; ++i) {
    const double most = is_length(i) ? scale_.length * kMaxLength : kMaxAngle;
    after_[i] = std::clamp(before_[i] + found[i], -most, most);
  }
}

void KinematicCalibration::fade() noexcept {
  if (share_ >= 1.0) return;
  share_ = std::min(1.0, share_ + period_ / (scale_.time() * kFadeIn));
  const Errors now = before_ + smoothstep(share_) * (after_ - before_);
  for (const Leg leg : kLegs) {
    const Eigen::Index first = kErrorsPerLeg * static_cast<Eigen::Index>(index(leg));
    in_use_.thigh[index(leg)] = now[first];
    in_use_.shank[index(leg)] = now[first + 1];
    in_use_.zero.segment<kJointsPerLeg>(first_joint(leg)) = now.segment<3>(first + 2);
  }
  in_use_.imu = now.segment<3>(kImu);
}

}  // namespace surefoot::estimation
