#pragma once

#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>
#include <vector>

namespace surefoot::estimation {

/// Compares the IMU with the stance feet, over the last `window` and shorter spans of it.
///
/// In a frame I that follows the gyroscope alone (R_IB), a foot k that stands and rolls is at
///
///     x_k = R_IB h_k(q) − Σ roll_k,    Δx_k = −Δp + φ × R_IB h_k
///
/// with φ the gyroscope's error in angle. Three feet give φ and a misfit. A foot that leaves an
/// edge looks like a short turn, but a faulty gyroscope keeps turning: φ must appear in both halves
/// of the span. The accelerometer's initial velocity is unknown, so the second half of the way is
/// compared with the first:
///
///     e_k = −ΔΔx_k − ΔΔ ∫∫ (R_IB a + g_I) dt²,    ΔΔy = y(t) − 2 y(t − T/2) + y(t − T)
///
/// The smallest e_k of all feet counts: a foot that slides or lifts off disagrees with a correct
/// IMU, but no foot agrees with a faulty one. An accelerometer error a gives e_k = a (T/2)². g_I
/// comes from the estimated attitude. An impact between two samples, which then differ by Δa,
/// leaves a velocity of at most Δa times the period unknown, for at most half of the span. Encoders
/// or an IMU without a new sample at every tick are too coarse: no verdict. Does not allocate after
/// construction.
class ImuCheck {
 public:
  static constexpr int kNumSpans = 4;

  ImuCheck(const ImuCheckOptions& options, double period, int num_legs = kNumLegs);

  /// One tick, with the dynamics at the state. `stands`: the feet planned to carry load; `normal_W`
  /// of the terrain.
  void update(const SensorReading& reading, const RobotState& state,
              const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              const Vec3& normal_W) noexcept;
  /// Discards the past, as the leg geometry has changed.
  void forget() noexcept;

  /// Does the robot turn fast and feel more or less than g?
  [[nodiscard]] bool tumbles(const SensorReading& reading) const;
  /// Duration of the IMU's fault [s]; 0: none.
  [[nodiscard]] double wrong_for() const { return wrong_for_; }
  /// Disagreement of each span, shortest first, as a share of the allowed one: the larger of
  /// displacement and turn.
  [[nodiscard]] const std::array<double, kNumSpans>& shares() const { return shares_; }

 private:
  /// One tick, in I.
  struct Moment {
    PerLeg<Vec3> x;             // of the feet, minus the rolled distance [m]
    Vec3 v_imu = Vec3::Zero();  // ∫ (R a + g) dt [m/s]
    double jump = 0.0;          // of the accelerometer since the tick before [m/s²]
  };

  /// Motion of the feet about their mean between two ticks.
  struct Turn {
    Vec3 angle = Vec3::Zero();  // [rad]
    double spread = 0.0;        // rms of their motion [m]
    double misfit = 0.0;        // rms of the part that the angle does not explain [m]
    double lever = 0.0;         // [m]
  };

  /// Difference between IMU and legs about the base's motion over a span.
  struct Disagreement {
    int feet = 0;               // that stood all the time; two give no turn, one nothing
    double displacement = 0.0;  // beyond a steady velocity, by the foot closest to the IMU [m]
    double spread = 0.0;        // motion of the feet against each other, which weakens it [m]
    double unseen = 0.0;        // possible effect of an impact between two samples [m]
    double turn = 0.0;  // twice the smaller half's, minus the explanation by sliding feet [rad]
  };

  [[nodiscard]] const Moment& before(int ticks) const;
  void move(const SensorReading& reading, const RobotState& state, const model::Dynamics& dynamics);
  [[nodiscard]] bool is_shaken(const SensorReading& reading, const RobotState& state,
                               const model::Dynamics& dynamics, const PerLeg<bool>& stands) const;
  void count_firm_feet(const RobotState& state, const PerLeg<bool>& stands, const Vec3& normal_W);
  [[nodiscard]] Vec3 imu_second_difference(int half) const;
  [[nodiscard]] double unseen_displacement(int ticks) const;
  /// Smallest difference between the displacements of the IMU and of a firm foot [m].
  [[nodiscard]] double least_displacement(const Vec3& second_difference, const PerLeg<bool>& firm,
                                          int ticks) const;
  /// Largest turn of a line between two firm feet [rad].
  [[nodiscard]] double largest_turn(const PerLeg<bool>& firm, int from, int to) const;
  [[nodiscard]] Disagreement compare(int ticks) const;
  [[nodiscard]] Turn turn(const PerLeg<bool>& firm, int from, int to) const;
  void judge();

  ImuCheckOptions options_;
  double period_;
  std::array<int, kNumSpans> ticks_{};
  std::vector<Moment> moments_;  // a ring
  int newest_ = 0;
  double time_ = kNaN, encoder_time_ = kNaN, imu_time_ = kNaN;  // of the last tick [s]
  Vec3 gyro_before_ = Vec3::Zero(), accelerometer_before_ = Vec3::Zero();
  Mat3 R_IB_ = Mat3::Identity();
  PerLeg<Mat3> R_IK_;    // shanks
  PerLeg<Vec3> arm_;     // from the base to the feet in I [m]
  PerLeg<Vec3> rolled_;  // [m]
  PerLeg<int> firm_ticks_;
  std::array<double, kNumSpans> shares_{};
  double disagrees_for_ = 0.0, wrong_for_ = 0.0;  // [s]
};

}  // namespace surefoot::estimation
