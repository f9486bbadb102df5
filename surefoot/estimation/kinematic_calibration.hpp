#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/signals/kinematic_errors.hpp"
#include "surefoot/signals/per_leg.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot::estimation {

/// Calibrates lengths of thighs and shanks, encoder zeros and the IMU's mounting, from stance feet
/// while the torso turns.
///
/// With R the base's orientation by the gyroscope, f_k the leg's forward kinematics and ρ_k the
/// rolled way of foot k, the vectors R f_k(q_k; θ_k) − ρ_k between the stance feet are constant.
/// Let y be these numbers, three a foot, minus their mean over the feet, and H = ∂y/∂θ, both minus
/// their mean over time. The errors θ are two lengths and three zeros a leg, the rotation m of B
/// against the IMU's axes, the gyroscope's bias and its delay τ. They minimize
///
///     min Σ_t ‖y + H θ‖²_W + ‖θ‖²_Π
///
/// W⁻¹ = Σ + σ_φ² B Bᵀ: Σ is the error of a foot's position, which creeps along the ground but does
/// not sink, and σ_φ that of the orientation, which turns all feet by B. The prior Π keeps θ at 0
/// where the motion gives no information. An IMU mounted askew turns about other axes than the
/// legs: with R₀ the orientation at the beginning, f and the gyroscope's ω in B
///
///     ∂y/∂m = R S(f) − S(R f) R₀,   ∂y/∂τ = R S(ω) f
///
/// Does not allocate.
class KinematicCalibration {
 public:
  static constexpr double kFadeIn = 0.6;  ///< of a new result, of a robot of scale 1 [s]

  /// `period` of the control loop [s].
  KinematicCalibration(const model::RobotDescription& robot, double period);

  /// One tick at its time [s]; `is_turning` while the torso turns on all feet. `dynamics` contain
  /// errors(). A few missed ticks are bridged with this tick's rate; a longer gap restarts the
  /// motion.
  void update(double time, const model::Dynamics& dynamics, const Vec3& gyro_B,
              const Vec3& terrain_normal_W, bool is_turning) noexcept;

  /// Discards this motion: a foot moved, or a push disturbed it.
  void forget() noexcept;

  /// Was the last motion long enough?
  [[nodiscard]] bool knows_legs() const { return knows_legs_; }
  /// The current result; a new one fades in within kFadeIn.
  [[nodiscard]] const KinematicErrors& errors() const { return in_use_; }

 private:
  static constexpr int kErrorsPerLeg = 2 + kJointsPerLeg;  // thigh, shank, the encoders' zeros
  static constexpr int kMaxCoordinates = 3 * kMaxLegs, kMaxErrors = kErrorsPerLeg * kMaxLegs + 7;
  template <int kMaxRows, int kMaxColumns>
  using Bounded = Eigen::Matrix<double, Eigen::Dynamic, kMaxColumns == 1 ? 1 : Eigen::Dynamic,
                                Eigen::ColMajor, kMaxRows, kMaxColumns>;
  using Coordinates = Bounded<kMaxCoordinates, 1>;
  using Weights = Bounded<kMaxCoordinates, kMaxCoordinates>;
  using Sensitivity = Bounded<kMaxCoordinates, kMaxErrors>;
  using Errors = Bounded<kMaxErrors, 1>;
  using Information = Bounded<kMaxErrors, kMaxErrors>;

  void start(const Mat3& R_WB) noexcept;
  void turn(const Vec3& gyro_B, double dt) noexcept;
  /// Whole periods, at least 1.
  [[nodiscard]] double periods_until(double time) const;
  void add_sample(const model::Dynamics& dynamics) noexcept;
  [[nodiscard]] Weights weights(const Coordinates& y) const;
  [[nodiscard]] bool is_length(int error) const {
    return error < imu_ && error % kErrorsPerLeg < 2;
  }
  /// Prior standard deviation of an error.
  [[nodiscard]] double prior(int error) const;
  void finish() noexcept;
  void fade() noexcept;

  double period_;
  double time_ = kNaN;  // of the last update [s]
  int ticks_per_sample_;
  PerLeg<double> foot_radius_;
  Scale scale_;  // of the robot
  PerLeg<model::LegChain> chains_;
  int num_legs_;
  int imu_, bias_, delay_, num_errors_;  // places of these errors, behind those of the legs
  PerLeg<Vec3> rolled_;
  Mat3 R_start_ = Mat3::Identity();
  Mat3 R_ = Mat3::Identity();   // of the base in W, from the gyroscope
  Vec3 gyro_ = Vec3::Zero();    // the last reading [rad/s]
  Mat3 turned_ = Mat3::Zero();  // ∫ R dt, the effect of a gyroscope bias [s]
  int ticks_ = 0, samples_ = 0;
  bool knows_legs_ = false;
  Weights W_;
  Coordinates sum_y_;
  Sensitivity sum_H_;
  Information sum_HWH_;
  Errors sum_HWy_;
  Errors before_, after_;
  Mat3 imu_covariance_before_, imu_covariance_after_;
  double share_ = 1.0;  // of the way from before to after
  KinematicErrors in_use_;
};

}  // namespace surefoot::estimation
