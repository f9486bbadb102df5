#include "surefoot/estimation/invariant_filter.hpp"

#include "surefoot/math/rotation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <cmath>

namespace surefoot::estimation {
namespace {

double square(double x) { return x * x; }

/// Left Jacobian of SO(3): exp of a twist moves points by J_l(θ) ξ.
Mat3 left_jacobian(const Vec3& theta) {
  const double angle = theta.norm();
  const Mat3 S = skew(theta);
  if (angle < 1e-4) return Mat3::Identity() + 0.5 * S + S * S / 6.0;
  const double square = angle * angle;
  return Mat3::Identity() + (1.0 - std::cos(angle)) / square * S +
         (angle - std::sin(angle)) / (square * angle) * S * S;
}

/// P ← P + c A Bᵀ of three columns, as loops: Eigen's product is made for larger matrices.
template <typename Square, typename Columns>
void add_product(Square& P, double c, const Columns& A, const Columns& B) {
  const Eigen::Index n = P.rows();
  const double *x = A.data(), *y = x + n, *z = y + n;
  for (Eigen::Index j = 0; j < n; ++j) {
    const Vec3 b = B.row(j);
    double* const column = P.data() + n * j;
    for (Eigen::Index i = 0; i < n; ++i) column[i] += c * (b[0] * x[i] + b[1] * y[i] + b[2] * z[i]);
  }
}

/// P ← ½ (P + Pᵀ).
template <typename Square>
void make_symmetric(Square& P) {
  const Eigen::Index n = P.rows();
  double* const p = P.data();
  for (Eigen::Index j = 1; j < n; ++j)
    for (Eigen::Index i = 0; i < j; ++i)
      p[i + n * j] = p[j + n * i] = 0.5 * (p[i + n * j] + p[j + n * i]);
}

}  // namespace

// Roll and pitch such that the specific force points up.
void InvariantFilter::start(const Vec3& specific_force, const Vec3& gyro_bias, double heading,
                            const Vec3& v_WB_B, double doubt) noexcept {
  const Quat level = Quat::FromTwoVectors(specific_force, Vec3::UnitZ());
  const Mat3 R = level.toRotationMatrix();
  R_ = rotation_about_z(heading - yaw(R)) * R;
  v_ = R_ * v_WB_B;
  p_.setZero();
  stands_.fill(false);
  gyro_bias_ = gyro_bias;
  accelerometer_bias_.setZero();
  P_.setZero();
  // Heading and position of W are chosen, not estimated: no variance.
  P_.diagonal().segment<2>(kTheta).setConstant(square(doubt * options_.initial_tilt));
  P_.diagonal().segment<3>(kVelocity).setConstant(square(doubt * options_.initial_velocity));
  P_.diagonal().segment<3>(gyro_bias_row()).setConstant(square(doubt * options_.initial_gyro_bias));
  P_.diagonal()
      .segment<3>(accelerometer_bias_row())
      .setConstant(square(options_.initial_accelerometer_bias));
}

//     θ̇ = −R ξ_g
//     ξ̇_v = S(g) θ − S(v) R ξ_g − R ξ_a
//     ξ̇_p = ξ_v − S(p) R ξ_g
//     ξ̇_d = −S(d) R ξ_g
InvariantFilter::Covariance InvariantFilter::advanced(const Covariance& P, double dt) const {
  Covariance result = P;
  const Rows turn = dt * R_ * P.middleRows<3>(gyro_bias_row());
  result.middleRows<3>(kTheta) -= turn;
  result.middleRows<3>(kVelocity) += dt * skew(kGravityVector) * P.middleRows<3>(kTheta) -
                                     skew(v_) * turn -
                                     dt * R_ * P.middleRows<3>(accelerometer_bias_row());
  result.middleRows<3>(kPosition) += dt * P.middleRows<3>(kVelocity) - skew(p_) * turn;
  for (const Leg leg : d_.legs()) {
    if (stands(leg)) result.middleRows<3>(foot(leg)) -= skew(p_WF(leg)) * turn;
  }
  return result;
}

// Gyroscope noise enters like the bias: through Ad_X (R, S(v) R, S(p) R, S(d) R).
void InvariantFilter::add_process_noise(double dt) {
  Columns turn = Columns::Zero(size(), 3);
  turn.middleRows<3>(kTheta).setIdentity();
  turn.middleRows<3>(kVelocity) = skew(v_);
  turn.middleRows<3>(kPosition) = skew(p_);
  for (const Leg leg : d_.legs()) {
    if (stands(leg)) turn.middleRows<3>(foot(leg)) = skew(p_WF(leg));
  }
  add_product(P_, dt * square(options_.gyro_noise), turn, turn);
  const auto add = [&](int first, double density) {
    P_.diagonal().segment<3>(first).array() += dt * square(density);
  };
  add(kVelocity, options_.accelerometer_noise);
  add(gyro_bias_row(), options_.gyro_bias_walk);
  add(accelerometer_bias_row(), options_.accelerometer_bias_walk);
}

void InvariantFilter::propagate(const Vec3& gyro, const Vec3& accelerometer, double dt) noexcept {
  P_ = advanced(advanced(P_, dt).transpose(), dt);
  add_process_noise(dt);
  const Vec3 angle = dt * (gyro - gyro_bias_);
  const Mat3 R_half = R_ * exp_rotation(0.5 * angle).toRotationMatrix();
  const Vec3 acceleration = R_half * (accelerometer - accelerometer_bias_) + kGravityVector;
  p_ += dt * v_ + 0.5 * dt * dt * acceleration;
  v_ += dt * acceleration;
  R_ = Quat(R_ * exp_rotation(angle).toRotationMatrix()).normalized().toRotationMatrix();
}

Mat3 InvariantFilter::measurement_noise(const Mat3& J) const {
  const Mat3 RJ = R_ * J;
  return square(options_.encoder_noise) * RJ * RJ.transpose() +
         square(options_.foot_position_noise) * Mat3::Identity();
}

// a_B = T a, so R ← R Tᵀ and b ← T b; θ is in W and stays. Only the IMU's vertical turns: the
// heading of B counts from the start, with the same axes of B.
void InvariantFilter::turn_imu(const Mat3& T) noexcept {
  const Mat3 turned = R_ * T.transpose();
  R_ = rotation_about_z(yaw(R_) - yaw(turned)) * turned;
  gyro_bias_ = T * gyro_bias_;
  accelerometer_bias_ = T * accelerometer_bias_;
  for (const int bias : {gyro_bias_row(), accelerometer_bias_row()}) {
    P_.middleRows<3>(bias) = (T * P_.middleRows<3>(bias)).eval();
    P_.middleCols<3>(bias) = (P_.middleCols<3>(bias) * T.transpose()).eval();
  }
}

// d̂ = p̂ + R̂ h, so ξ_d = ξ_p + the measurement's noise.
void InvariantFilter::plant(Leg leg, const Vec3& h, const Mat3& J) noexcept {
  const int k = foot(leg);
  stands_[index(leg)] = true;
  d_[index(leg)] = p_ + R_ * h;
  P_.middleRows<3>(k) = P_.middleRows<3>(kPosition);
  P_.middleCols<3>(k) = P_.middleCols<3>(kPosition);
  P_.block<3, 3>(k, k) += measurement_noise(J);
}

void InvariantFilter::release(Leg leg) noexcept {
  stands_[index(leg)] = false;
  P_.middleRows<3>(foot(leg)).setZero();
  P_.middleCols<3>(foot(leg)).setZero();
}

void InvariantFilter::move(Leg leg, const Vec3& step, double walk) noexcept {
  d_[index(leg)] += step;
  P_.diagonal().segment<3>(foot(leg)).array() += square(walk);
}

void InvariantFilter::turn_feet(double turn) noexcept {
  Error moved = Error::Zero(size());
  for (const Leg leg : d_.legs()) {
    if (stands(leg)) {
      moved.segment<3>(foot(leg)) = turn * Vec3::UnitZ().cross(d_[index(leg)] - p_);
    }
  }
  P_.noalias() += moved * moved.transpose();
}

void InvariantFilter::correct(Leg leg, const Vec3& h, const Mat3& J) noexcept {
  const int k = foot(leg);
  const Vec3 innovation = R_ * h - (d_[index(leg)] - p_);
  const Rows HP = P_.middleRows<3>(kPosition) - P_.middleRows<3>(k);
  const Mat3 S = HP.middleCols<3>(kPosition) - HP.middleCols<3>(k) + measurement_noise(J);
  const double distance = innovation.dot(S.ldlt().solve(innovation));
  Columns PHt = HP.transpose();
  Mat3 S_used = S;
  if (distance > options_.gate) {
    // The implausible part of the motion becomes variance of the foot, as a slip of that size.
    const double slip = (distance / options_.gate - 1.0) * S.trace() / 3.0;
    P_.diagonal().segment<3>(k).array() += slip;
    PHt.middleRows<3>(k).diagonal().array() -= slip;
    S_used.diagonal().array() += slip;
  }
  const Columns K = S_used.ldlt().solve(PHt.transpose()).transpose();
  add_product(P_, -1.0, K, PHt);
  make_symmetric(P_);
  retract(K * innovation);
}

void InvariantFilter::retract(const Error& xi) {
  const Vec3 theta = -xi.segment<3>(kTheta);
  const Mat3 turn = exp_rotation(theta).toRotationMatrix();
  const Mat3 J = left_jacobian(theta);
  R_ = turn * R_;
  v_ = turn * v_ - J * xi.segment<3>(kVelocity);
  p_ = turn * p_ - J * xi.segment<3>(kPosition);
  for (const Leg leg : d_.legs()) {
    if (stands(leg)) {
      d_[index(leg)] = turn * d_[index(leg)] - J * xi.segment<3>(foot(leg));
    }
  }
  gyro_bias_ -= xi.segment<3>(gyro_bias_row());
  accelerometer_bias_ -= xi.segment<3>(accelerometer_bias_row());
}

}  // namespace surefoot::estimation
