#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

#include <Eigen/Core>

#include <array>

namespace surefoot::estimation {

/// When a swing leg of the reference robot is measured; others scale with `Scale`.
struct SwingTareOptions {
  bool enabled = true;
  double begin = 0.04;  ///< after lift-off; the foot may touch before [s]
  double end = 0.35;    ///< after lift-off; the ground may be near later [s]
  double wait = 0.06;   ///< a sample counts after so long without a touchdown [s]
  double most = 6.0;    ///< a larger torque is no model error, but a disturbed leg [N·m]
  double memory = 3.0;  ///< of the time in the air [s]
  /// Of a sample [N·m]. The unexplained 0.5 N·m is constant over a swing: its 125 samples count as
  /// one, so each is √125 times as noisy.
  double noise = 5.6;
};

/// Learns the torque error of a free swing leg, due to link masses, drive gains and friction. For
/// joint j
///
///     r_j ≈ θ_jᵀ (1, τ_j, q̇_j, q̈_j)
///
/// with θ_j from least squares over the last swings, older samples weighted e^(−age / memory), with
/// a prior at 0; refitted at each touchdown. r comes from an observer with three poles at ω: three
/// low-passes delay τ, q̇ and q̈ alike. Ours (decision 0016). Does not allocate.
class SwingTare {
 public:
  /// `bandwidth` ω of the observer [rad/s]; `period` of the control loop [s],
  /// `scale` of the robot.
  SwingTare(const SwingTareOptions& options, double bandwidth, double period,
            const Scale& scale = {}, int num_legs = kNumLegs);

  /// A tick: the model's torque error r [N·m], with the measured torques [N·m], velocities [rad/s]
  /// and accelerations [rad/s²], of legs first. `stands`: the feet in contact.
  void update(const PerLeg<bool>& stands, const LegJointVector& missing, const JointVector& torque,
              const JointVector& velocity, const JointVector& acceleration) noexcept;

  /// θ_jᵀ (1, τ_j, q̇_j, q̈_j) of swing legs, 0 of stance legs [N·m].
  [[nodiscard]] const LegJointVector& tare() const { return tare_; }

 private:
  static constexpr int kNumFeatures = 4;
  static constexpr std::size_t kMaxWaiting = 64;
  using Features = Eigen::Matrix<double, kNumFeatures, 1>;
  using Moments = Eigen::Matrix<double, kNumFeatures, kNumFeatures>;

  struct Sample {
    std::array<Features, kJointsPerLeg> features;
    Vec3 missing;
  };
  struct Joint {
    Moments moments = Moments::Zero();
    Features products = Features::Zero();
    Features theta = Features::Zero();
  };
  struct LegTare {
    std::array<Sample, kMaxWaiting> waiting;
    std::size_t num_seen = 0;  // in this swing
    double air_time = 0.0;     // [s]
    std::array<Joint, kJointsPerLeg> joints;
  };

  using Signals = Eigen::Matrix<double, Eigen::Dynamic, kNumFeatures - 1, Eigen::ColMajor,
                                LegJointVector::MaxRowsAtCompileTime, kNumFeatures - 1>;
  static constexpr int kNumPoles = 3;

  /// τ, q̇, q̈ of all joints as the observer has them.
  const Signals& lagged(const Signals& now) noexcept;
  void fit(Joint& joint) const;
  void enqueue(LegTare& leg, const Sample& sample);
  void learn(LegTare& leg, const Sample& sample) const;

  SwingTareOptions options_;  // of this robot
  Eigen::Vector4d usual_;     // size of θ, as `kUsual`
  double period_;
  double forgetting_;
  double low_pass_gain_;
  std::array<Signals, kNumPoles> stages_;  // NaN until there are signals
  std::size_t wait_;                       // [ticks]
  PerLeg<LegTare> legs_;
  LegJointVector tare_;
};

}  // namespace surefoot::estimation
