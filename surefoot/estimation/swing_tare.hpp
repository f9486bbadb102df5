#pragma once

#include "surefoot/signals/leg.hpp"

#include <Eigen/Core>

#include <array>

namespace surefoot {

/// When a leg in the air is weighed.
struct SwingTareOptions {
  bool enabled = true;
  double begin = 0.04;  ///< after lift-off; before, the foot may still touch [s]
  double end = 0.35;    ///< after lift-off; later, the ground is near [s]
  double wait = 0.06;   ///< what was seen counts if no touchdown is believed for so long [s]
  double most = 6.0;    ///< more than this is no error of a model, something holds the leg [N·m]
  double memory = 3.0;  ///< of the time in the air [s]
  /// Of a sample, beside what is learnt [N·m]. What the features don't explain, 0.5 N·m, is alike
  /// over a swing: its 125 samples say no more than one would, so each is √125 times as noisy.
  double noise = 5.6;
};

/// What the joint torques of a leg that swings freely lack to explain its motion: links heavier
/// than modelled, drives stronger, friction. Of joint j
///
///     r_j ≈ θ_jᵀ (1, τ_j, q̇_j, q̈_j)
///
/// with θ_j from least squares over the last swings, older samples weighted e^(−age / memory), and
/// pulled to 0 until it is known better; fitted anew at each touchdown. r comes from an observer
/// with three poles at ω: τ, q̇ and q̈ are lagged like it, by three low-passes.
/// Ours (decision 0016). Does not allocate.
class SwingTare {
 public:
  /// `bandwidth` ω of the observer [rad/s]; `period` of the control loop [s].
  SwingTare(const SwingTareOptions& options, double bandwidth, double period);

  /// A tick: the joint torques r [N·m] that the model lacks, with the measured torques [N·m], the
  /// velocities [rad/s] and accelerations [rad/s²]. `stands` says which feet are believed to carry.
  void update(const PerLeg<bool>& stands, const JointVector& missing, const JointVector& torque,
              const JointVector& velocity, const JointVector& acceleration) noexcept;

  /// θ_jᵀ (1, τ_j, q̇_j, q̈_j) of legs in the air, 0 of legs that stand [N·m].
  [[nodiscard]] const JointVector& tare() const { return tare_; }

 private:
  static constexpr int kNumFeatures = 4;
  static constexpr std::size_t kMostWaiting = 64;
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
    std::array<Sample, kMostWaiting> waiting;
    std::size_t num_seen = 0;  // in this swing
    double in_the_air = 0.0;   // [s]
    std::array<Joint, kJointsPerLeg> joints;
  };

  using Signals = Eigen::Matrix<double, kNumJoints, kNumFeatures - 1>;
  static constexpr int kNumPoles = 3;

  /// τ, q̇, q̈ of all joints as the observer has them.
  const Signals& lagged(const Signals& now) noexcept;
  void fit(Joint& joint) const;
  void weigh(LegTare& leg, const Sample& sample);
  void learn(LegTare& leg, const Sample& sample) const;

  SwingTareOptions options_;
  double period_;
  double forgetting_;
  double follows_;                         // a low-pass's share of what is new, in a tick
  std::array<Signals, kNumPoles> stages_;  // NaN until there are signals
  std::size_t wait_;                       // [ticks]
  PerLeg<LegTare> legs_{};
  JointVector tare_ = JointVector::Zero();
};

}  // namespace surefoot
