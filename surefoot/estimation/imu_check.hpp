#pragma once

#include "surefoot/estimation/sensor_consistency_options.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>
#include <vector>

namespace surefoot {

/// What the IMU and the legs say differently of how the base moved over a span of time.
struct ImuDisagreement {
  int feet = 0;  ///< that stood all the time; one says nothing, two nothing of the turn
  /// Of the base, beyond a steady velocity, by the foot that agrees most with the IMU [m].
  double displacement = 0.0;
  double spread = 0.0;  ///< how far the feet moved against each other, which casts doubt on it [m]
  double unseen = 0.0;  ///< what a blow between two samples may have added to it [m]
  double turn = 0.0;    ///< twice the lesser of both halves, less what feet that slid explain [rad]
};

/// Compares the IMU with the feet that stand, over the last `window` and shorter spans of it.
///
/// In a frame I that the gyroscope alone carries along (R_IB), a foot k that stands and rolls is at
///
///     x_k = R_IB h_k(q) − Σ roll_k,    Δx_k = −Δp + φ × R_IB h_k
///
/// where φ is what the gyroscope turned too far: three feet give φ, and as misfit what is left
/// over. A foot that comes off an edge looks like a turn for a moment, a gyroscope that is off
/// turns on: φ must be there in both halves of the span. Of the accelerometer, the velocity at the
/// beginning is not known, so the second halves of the way are held against the first:
///
///     e_k = −ΔΔx_k − ΔΔ ∫∫ (R_IB a + g_I) dt²,    ΔΔy = y(t) − 2 y(t − T/2) + y(t − T)
///
/// and the least of all feet counts: one that slides or flies off disagrees with an IMU that is
/// right, but no foot agrees with one that is wrong.
/// An accelerometer that is off by a gives e_k = a (T/2)². g_I is by the believed attitude. A foot
/// that strikes the ground does so between two samples, which differ by Δa then: of the velocity at
/// most Δa times the period is not known, for at most half of the span. Encoders or an IMU without
/// a new sample at every tick are too coarse for this: nothing is said of them. Does not allocate
/// after construction.
class ImuCheck {
 public:
  static constexpr int kNumSpans = 4;

  ImuCheck(const ImuCheckOptions& options, double period);

  /// One tick, with the dynamics at the state. `stands` says which feet the plan lets carry,
  /// `normal_W` is the terrain's.
  void update(const SensorReading& reading, const RobotState& state, const Dynamics& dynamics,
              const PerLeg<bool>& stands, const Vec3& normal_W) noexcept;
  /// The legs are known to be other than they were believed to be.
  void forget() noexcept;

  /// Does the robot turn fast and feel more or less than g?
  [[nodiscard]] bool tumbles(const SensorReading& reading) const;
  /// How long the IMU has been wrong for [s]; 0: it is not.
  [[nodiscard]] double wrong_for() const { return wrong_for_; }
  /// Of each span, shortest first, as shares of what is allowed: of displacement and turn the
  /// larger.
  [[nodiscard]] const std::array<double, kNumSpans>& shares() const { return shares_; }
  [[nodiscard]] const ImuDisagreement& of_span(int span) const {
    return disagreements_[static_cast<std::size_t>(span)];
  }
  /// [s]
  [[nodiscard]] double span(int span) const;

 private:
  /// What is known of a tick, in I.
  struct Moment {
    PerLeg<Vec3> x;             // of the feet, less how far they rolled [m]
    Vec3 v_imu = Vec3::Zero();  // ∫ (R a + g) dt [m/s]
    double jump = 0.0;          // of the accelerometer since the tick before [m/s²]
  };

  /// Of the feet about their mean, between two ticks.
  struct Turn {
    Vec3 angle = Vec3::Zero();  // [rad]
    double spread = 0.0;        // of how far they moved [m]
    double misfit = 0.0;        // what the angle does not explain of it [m]
    double lever = 0.0;         // [m]
  };

  [[nodiscard]] const Moment& before(int ticks) const;
  void move(const SensorReading& reading, const RobotState& state, const Dynamics& dynamics);
  [[nodiscard]] bool is_thrown(const SensorReading& reading, const RobotState& state,
                               const Dynamics& dynamics, const PerLeg<bool>& stands) const;
  void count_firm_feet(const RobotState& state, const PerLeg<bool>& stands, const Vec3& normal_W);
  [[nodiscard]] Vec3 second_way_of_imu(int half) const;
  [[nodiscard]] double unseen_way(int ticks) const;
  /// Between the IMU's way and that of the foot of these that agrees most with it [m].
  [[nodiscard]] double least_displacement(const Vec3& second_way, const PerLeg<bool>& firm,
                                          int ticks) const;
  /// By how much a line between two of these feet has turned, at most [rad].
  [[nodiscard]] double swing(const PerLeg<bool>& firm, int from, int to) const;
  [[nodiscard]] ImuDisagreement compare(int ticks) const;
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
  PerLeg<Mat3> R_IS_;    // shanks
  PerLeg<Vec3> arm_;     // of the feet from the base in I [m]
  PerLeg<Vec3> rolled_;  // [m]
  PerLeg<int> firm_ticks_{};
  std::array<ImuDisagreement, kNumSpans> disagreements_{};
  std::array<double, kNumSpans> shares_{};
  double lasts_ = 0.0, wrong_for_ = 0.0;  // [s]
};

}  // namespace surefoot
