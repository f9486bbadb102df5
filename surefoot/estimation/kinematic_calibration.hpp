#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/signals/kinematic_errors.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// Lengths of thighs and shanks, zeros of encoders and the IMU's mounting, from feet that stand
/// while the torso turns.
///
/// With R the base's orientation as the gyroscope tells its changes, f_k the leg's forward
/// kinematics and ρ_k the way that foot k has rolled, the vectors R f_k(q_k; θ_k) − ρ_k between the
/// standing feet stay what they are. With y these twelve numbers, less their mean over the feet,
/// and H = ∂y/∂θ, both less their mean over time, the errors θ (two lengths and three zeros a leg,
/// the rotation m of B against the IMU's axes, and beside these the gyroscope's bias and the time τ
/// by which it is late) are those of
///
///     min Σ_t ‖y + H θ‖²_W + ‖θ‖²_Π
///
/// W⁻¹ = Σ + σ_φ² B Bᵀ: Σ is the error of a foot's position, which creeps along the ground but does
/// not sink, and σ_φ that of the orientation, which turns all feet by B. Π is what is known
/// beforehand: where the motion says nothing, θ stays 0. An IMU that is askew turns about other
/// axes than the legs do: with R₀ the orientation at the beginning, f and the gyroscope's ω in B
///
///     ∂y/∂m = R S(f) − S(R f) R₀,   ∂y/∂τ = R S(ω) f
///
/// Does not allocate.
class KinematicCalibration {
 public:
  static constexpr double kFadeIn = 0.6;  ///< of a new result [s]

  /// `period` of the control loop [s].
  KinematicCalibration(const RobotDescription& robot, double period);

  /// One tick at its time [s]; `listening` while the torso turns with all feet down. `dynamics`
  /// with the errors that errors() gave. Over a few missed ticks it turns on as it does at this
  /// one; a motion with a longer gap begins anew.
  void update(double time, const Dynamics& dynamics, const Vec3& gyro_B,
              const Vec3& terrain_normal_W, bool listening) noexcept;

  /// What was heard in this motion is worth nothing: a foot did not stay, or somebody pushed.
  void forget() noexcept;

  /// Was the last motion heard for long enough?
  [[nodiscard]] bool knows_legs() const { return knows_legs_; }
  /// What is known so far. A new result fades in within kFadeIn.
  [[nodiscard]] const KinematicErrors& errors() const { return in_use_; }

 private:
  static constexpr int kNumCoordinates = 3 * kNumLegs;
  static constexpr int kErrorsPerLeg = 2 + kJointsPerLeg;  // thigh, shank, the encoders' zeros
  static constexpr int kNumLegErrors = kErrorsPerLeg * kNumLegs;
  static constexpr int kImu = kNumLegErrors, kBias = kImu + 3, kLate = kBias + 3;
  static constexpr int kNumErrors = kLate + 1;
  using Coordinates = Eigen::Matrix<double, kNumCoordinates, 1>;
  using Weights = Eigen::Matrix<double, kNumCoordinates, kNumCoordinates>;
  using Sensitivity = Eigen::Matrix<double, kNumCoordinates, kNumErrors>;
  using Errors = Eigen::Matrix<double, kNumErrors, 1>;
  using Information = Eigen::Matrix<double, kNumErrors, kNumErrors>;

  void start(const Mat3& R_WB) noexcept;
  void turn(const Vec3& gyro_B, double dt) noexcept;
  /// Whole ones, 1 at least.
  [[nodiscard]] double periods_until(double time) const;
  void add_sample(const Dynamics& dynamics) noexcept;
  [[nodiscard]] static Weights weights(const Coordinates& y);
  [[nodiscard]] static bool is_length(int error) {
    return error < kImu && error % kErrorsPerLeg < 2;
  }
  /// Standard deviation of an error, known beforehand.
  [[nodiscard]] static double prior(int error);
  void finish() noexcept;
  void fade() noexcept;

  double period_;
  double time_ = kNaN;  // of the last update [s]
  int ticks_per_sample_;
  double foot_radius_;
  PerLeg<LegChain> chains_;
  PerLeg<Vec3> rolled_{};
  Mat3 R_start_ = Mat3::Identity();
  Mat3 R_ = Mat3::Identity();   // of the base in W, from the gyroscope
  Vec3 gyro_ = Vec3::Zero();    // the last reading [rad/s]
  Mat3 turned_ = Mat3::Zero();  // ∫ R dt, by which a bias turns it [s]
  int ticks_ = 0, samples_ = 0;
  bool knows_legs_ = false;
  Weights W_ = Weights::Zero();
  Coordinates sum_y_ = Coordinates::Zero();
  Sensitivity sum_H_ = Sensitivity::Zero();
  Information sum_HWH_ = Information::Zero();
  Errors sum_HWy_ = Errors::Zero();
  Errors before_ = Errors::Zero(), after_ = Errors::Zero();
  double share_ = 1.0;  // of the way from before to after
  KinematicErrors in_use_;
};

}  // namespace surefoot
