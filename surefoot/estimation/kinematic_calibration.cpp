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
      foot_radius_(robot.num_legs(), 0.0),
      scale_(robot.scale),
      num_legs_(robot.num_legs()),
      imu_(kErrorsPerLeg * num_legs_),
      bias_(imu_ + 3),
      delay_(bias_ + 3),
      num_errors_(delay_ + 1),
      rolled_(num_legs_, Vec3::Zero()),
      W_(Weights::Zero(3 * num_legs_, 3 * num_legs_)),
      sum_y_(Coordinates::Zero(3 * num_legs_)),
      sum_H_(Sensitivity::Zero(3 * num_legs_, num_errors_)),
      sum_HWH_(Information::Zero(num_errors_, num_errors_)),
      sum_HWy_(Errors::Zero(num_errors_)),
      before_(sum_HWy_),
      after_(sum_HWy_),
      imu_covariance_before_(kZeroPrior * kZeroPrior * Mat3::Identity()),
      imu_covariance_after_(imu_covariance_before_),
      in_use_(no_errors(num_legs_)) {
  in_use_.imu_covariance = imu_covariance_after_;
  const model::BodyTree tree = model::make_body_tree(robot, model::read_urdf(robot));
  chains_.resize(num_legs_);
  for (const Leg leg : chains_.legs()) {
    chains_[index(leg)] = tree.legs[index(leg)].chain;
    foot_radius_[index(leg)] = robot.legs[index(leg)].foot_radius;
  }
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
  for (const Leg leg : rolled_.legs()) {
    rolled_[index(leg)] +=
        dt * dynamics.shank[index(leg)].w.cross(foot_radius_[index(leg)] * normal);
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
  Coordinates y(3 * num_legs_);
  Sensitivity H = Sensitivity::Zero(3 * num_legs_, num_errors_);
  const Mat3 R_from_W = R_ * dynamics.base_rotation.R.transpose();
  for (const Leg leg : rolled_.legs()) {
    const Eigen::Index k = 3 * static_cast<Eigen::Index>(index(leg));
    const Eigen::Index first = kErrorsPerLeg * static_cast<Eigen::Index>(index(leg));
    const Vec3 q = dynamics.q.segment<kJointsPerLeg>(first_joint(leg));
    const Vec3 lever = R_from_W * (dynamics.foot[index(leg)].p - dynamics.base.p);
    y.segment<3>(k) = lever - rolled_[index(leg)];
    H.block<3, 2>(k, first) = R_ * chains_[index(leg)].lengthening_in_base(q);
    H.block<3, 3>(k, first + 2) = -R_from_W * model::leg_jacobian(dynamics.foot[index(leg)], leg);
    const Vec3 f = R_.transpose() * lever;
    H.block<3, 3>(k, imu_) = R_ * skew(f) - skew(lever) * R_start_;
    H.block<3, 3>(k, bias_) = skew(lever) * turned_;
    H.block<3, 1>(k, delay_) = R_ * gyro_.cross(f);
  }
  Vec3 mean = Vec3::Zero();
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxErrors>;
  Rows mean_H = Rows::Zero(3, num_errors_);
  for (int k = 0; k < num_legs_; ++k) {
    mean += y.segment<3>(3 * k) / num_legs_;
    mean_H += H.middleRows<3>(3 * k) / num_legs_;
  }
  for (int k = 0; k < num_legs_; ++k) {
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
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxCoordinates, 3> B(y.size(), 3);
  Coordinates variance(y.size());
  for (int k = 0; k < num_legs_; ++k) {
    B.middleRows<3>(3 * k) = kTurnError * skew(y.segment<3>(3 * k));
    variance.segment<3>(3 * k) << creep * creep, creep * creep, sinking * sinking;
  }
  return (Weights(variance.asDiagonal()) + B * B.transpose()).inverse();
}

double KinematicCalibration::prior(int error) const {
  if (error == delay_) return kDelayPrior;
  if (error >= bias_) return kBiasPrior;
  return is_length(error) ? scale_.length * kLengthPrior : kZeroPrior;
}

void KinematicCalibration::finish() noexcept {
  Information A = sum_HWH_ - sum_H_.transpose() * W_ * sum_H_ / samples_;
  const Errors b = sum_HWy_ - sum_H_.transpose() * (W_ * sum_y_) / samples_;
  for (int i = 0; i < num_errors_; ++i) A(i, i) += 1.0 / (prior(i) * prior(i));
  const auto factors = A.ldlt();
  const Errors found = -factors.solve(b);
  using ImuColumns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxErrors, 3>;
  ImuColumns imu = ImuColumns::Zero(num_errors_, 3);
  imu.middleRows<3>(imu_).setIdentity();
  imu_covariance_before_ = imu_covariance_after_;
  imu_covariance_after_ = factors.solve(imu).middleRows<3>(imu_);
  knows_legs_ = true;
  before_ = after_;
  share_ = 0.0;
  for (int i = 0; i < bias_; ++i) {
    const double most = is_length(i) ? scale_.length * kMaxLength : kMaxAngle;
    after_[i] = std::clamp(before_[i] + found[i], -most, most);
  }
}

void KinematicCalibration::fade() noexcept {
  if (share_ >= 1.0) return;
  share_ = std::min(1.0, share_ + period_ / (scale_.time() * kFadeIn));
  const Errors now = before_ + smoothstep(share_) * (after_ - before_);
  for (const Leg leg : rolled_.legs()) {
    const Eigen::Index first = kErrorsPerLeg * static_cast<Eigen::Index>(index(leg));
    in_use_.thigh[index(leg)] = now[first];
    in_use_.shank[index(leg)] = now[first + 1];
    in_use_.zero.segment<kJointsPerLeg>(first_joint(leg)) = now.segment<3>(first + 2);
  }
  in_use_.imu = now.segment<3>(imu_);
  in_use_.imu_covariance = imu_covariance_before_ +
                           smoothstep(share_) * (imu_covariance_after_ - imu_covariance_before_);
}

}  // namespace surefoot::estimation
