#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot::estimation {

/// Standard deviations for an InvariantFilter.
struct InvariantFilterOptions {
  double gyro_noise = 2e-4, accelerometer_noise = 2e-3;
  /// A bias that wanders by σ within a time T walks by at most σ √(2/T). These fit MEMS sensors: a
  /// gyroscope with 5e-4 rad/s in 1000 s and an accelerometer with 0.025 m/s² in 300 s. If they are
  /// too small, the filter trusts its tilt too much, takes the accelerometer's contradiction for a
  /// bias, and its tilt drifts off within a minute.
  double gyro_bias_walk = 2e-5, accelerometer_bias_walk = 2e-3;
  double encoder_noise = 2.5e-4, foot_position_noise = 2e-3;
  double gate = 16.3;
  double initial_tilt = 0.01, initial_velocity = 0.005;
  double initial_gyro_bias = 2e-3, initial_accelerometer_bias = 0.12;
};

/// Contact-aided invariant extended Kalman filter (Hartley, Ghaffari, Eustice, Grizzle 2020, with
/// the right-invariant error): orientation R, velocity v and position p of the IMU, positions d_k
/// of the stance feet, and the IMU's biases b_g, b_a.
///
///     Ṙ = R S(ω − b_g),   v̇ = R (a − b_a) + g,   ṗ = v,   ḋ_k = 0       (each with white noise)
///     measured:  R h_k(q) = d_k − p                                      (a foot k that stands)
///
/// The error ξ = (θ, ξ_v, ξ_p, ξ_d1 … ξ_dn, ξ_g, ξ_a) is defined by X̂ = exp(ξ) X and b̂ = b + ξ, so
/// the measurement is linear in it: R̂ h − (d̂ − p̂) = ξ_p − ξ_d. Position and heading of W start with
/// the robot's and drift, as they are not observable. Does not allocate.
class InvariantFilter {
 public:
  static constexpr int kTheta = 0, kVelocity = 3, kPosition = 6, kFeet = 9;
  static constexpr int kMaxSize = kFeet + 3 * kMaxLegs + 6;
  using Covariance =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxSize, kMaxSize>;

  explicit InvariantFilter(const InvariantFilterOptions& options = {}, int num_legs = kNumLegs)
      : options_(options),
        d_(num_legs, Vec3::Zero()),
        stands_(num_legs, false),
        P_(Covariance::Zero(size(), size())) {}

  /// Starts at the origin with a heading [rad] and a velocity in B [m/s], level by the mean
  /// specific force in B at rest [m/s²]. Multiplies the initial deviations of tilt, velocity and
  /// gyroscope bias, not of the accelerometer bias, by `doubt`. No foot stands yet.
  void start(const Vec3& specific_force, const Vec3& gyro_bias, double heading = 0.0,
             const Vec3& v_WB_B = Vec3::Zero(), double doubt = 1.0) noexcept;

  /// Sets the base's position, right after the start.
  void place(const Vec3& p_WB) noexcept { p_ = p_WB; }

  /// Turns the IMU's axes: its measurement a in B becomes T a. The heading stays.
  void turn_imu(const Mat3& T) noexcept;

  /// Integrates `dt` [s] with the mean readings of gyroscope and accelerometer over it,
  /// in B.
  void propagate(const Vec3& gyro, const Vec3& accelerometer, double dt) noexcept;

  /// Foot k begins to stand at h, its position in B [m]; J = ∂h/∂q of its leg.
  void plant(Leg leg, const Vec3& h, const Mat3& J) noexcept;
  /// Foot k leaves the ground.
  void release(Leg leg) noexcept;
  /// A stance foot moved by `step` in W [m], as a rolling sphere does, and may have
  /// slipped by `walk` (standard deviation of each axis, [m]).
  void move(Leg leg, const Vec3& step, double walk) noexcept;

  /// The stance feet may have turned together about the vertical through the base
  /// (standard deviation, [rad]).
  void turn_feet(double turn) noexcept;

  /// Corrects by a stance foot's position in B. An outlier counts as a slip: it moves
  /// the foot, hardly the base.
  void correct(Leg leg, const Vec3& h, const Mat3& J) noexcept;

  [[nodiscard]] const Mat3& R_WB() const { return R_; }
  [[nodiscard]] const Vec3& v_WB() const { return v_; }
  [[nodiscard]] const Vec3& p_WB() const { return p_; }
  [[nodiscard]] const Vec3& p_WF(Leg leg) const { return d_[index(leg)]; }
  [[nodiscard]] bool stands(Leg leg) const { return stands_[index(leg)]; }
  [[nodiscard]] const Vec3& gyro_bias() const { return gyro_bias_; }
  [[nodiscard]] const Vec3& accelerometer_bias() const { return accelerometer_bias_; }
  /// Places of ξ_g and ξ_a.
  [[nodiscard]] int gyro_bias_row() const { return kFeet + 3 * static_cast<int>(d_.size()); }
  [[nodiscard]] int accelerometer_bias_row() const { return gyro_bias_row() + 3; }
  /// Of ξ; rows and columns of feet that don't stand are zero.
  [[nodiscard]] const Covariance& covariance() const { return P_; }

 private:
  using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxSize>;
  using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::ColMajor, kMaxSize, 3>;
  using Error = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxSize, 1>;

  [[nodiscard]] int size() const { return gyro_bias_row() + 6; }

  [[nodiscard]] static int foot(Leg leg) { return kFeet + 3 * static_cast<int>(leg); }
  /// P + dt A P for the error's dynamics ξ̇ = A ξ.
  [[nodiscard]] Covariance advanced(const Covariance& P, double dt) const;
  void add_process_noise(double dt);
  [[nodiscard]] Mat3 measurement_noise(const Mat3& J) const;
  /// X ← exp(−ξ) X.
  void retract(const Error& xi);

  InvariantFilterOptions options_;
  Mat3 R_ = Mat3::Identity();
  Vec3 v_ = Vec3::Zero(), p_ = Vec3::Zero();
  PerLeg<Vec3> d_;
  PerLeg<bool> stands_;
  Vec3 gyro_bias_ = Vec3::Zero(), accelerometer_bias_ = Vec3::Zero();
  Covariance P_;
};

}  // namespace surefoot::estimation
