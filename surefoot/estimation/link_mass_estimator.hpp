#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot {

/// When a leg in the air says what its links weigh, and how much is believed.
struct LinkMassOptions {
  bool enabled = true;
  double begin = 0.04;        ///< of the window, after lift-off: before, the foot may touch [s]
  double duration = 0.20;     ///< of the window [s]
  double wait = 0.05;         ///< what was seen counts if no touchdown is believed for so long [s]
  double usual_share = 0.09;  ///< by which masses are off the model's, rms
  double usual_delay = 0.0025;  ///< how far apart torques and angles are sampled, rms [s]
  double noise = 0.04;          ///< of a window's mean torque [N·m]
  double most_sigmas = 4.0;     ///< rms; of a swing that fits less well something holds the leg
};

/// What the links of the legs weigh, from legs in the air.
///
/// With the shares s_l by which links are heavier than modelled, and torques sampled d later than
/// angles, a leg that nothing holds moves so that, for each weight φ that is 0 at both ends of a
/// window of length T (integrated by parts: no acceleration is needed, of joints or base),
///
///     ∫ φ τ_j dt + d ∫ φ̇ τ_j dt = −Σ_l (1 + s_l) ∫ (φ̇ momentum_jl + φ free_rate_jl) dt
///
/// (LegLinks), for φ = 2/T sin²(πt/T) cos(nπt/T), n = 0, 1, 2. The 12 shares and d by recursive
/// least squares, pulled to 0 until they are known better. Ours (decision 0019), after the
/// weighted integrals of modulating functions (Shinbrot 1954). Does not allocate.
class LinkMassEstimator {
 public:
  static constexpr int kNumLinks = kNumLegs * kJointsPerLeg;
  using Shares = Eigen::Matrix<double, kNumLinks, 1>;

  LinkMassEstimator(const LinkMassOptions& options, double period);

  /// A tick at `time` [s]: `stands` says which feet are believed to carry, `torque` is the measured
  /// one [N·m]. Of a swing in which a tick is missed nothing is learnt.
  void update(double time, const Dynamics& dynamics, const PerLeg<bool>& stands,
              const JointVector& torque) noexcept;

  /// By which share of its modelled mass each link is heavier: of LF hip, thigh, shank, of RF …
  /// At most 0.5 of it either way.
  [[nodiscard]] Shares shares() const;
  /// By how much torques are sampled later than angles [s].
  [[nodiscard]] double delay() const { return state_[kNumLinks]; }

 private:
  static constexpr int kNumUnknowns = kNumLinks + 1;
  static constexpr int kNumWeights = 3;
  static constexpr int kNumRows = kNumWeights * kJointsPerLeg;
  using Unknowns = Eigen::Matrix<double, kNumUnknowns, 1>;
  using Covariance = Eigen::Matrix<double, kNumUnknowns, kNumUnknowns>;
  using Rows = Eigen::Matrix<double, kNumRows, 1>;

  /// The integrals of a swing so far; a row for each weight and joint.
  struct Swing {
    int ticks = 0;  // in the air
    Eigen::Matrix<double, kNumRows, kJointsPerLeg> links =
        Eigen::Matrix<double, kNumRows, kJointsPerLeg>::Zero();
    Rows torque = Rows::Zero(), torque_slope = Rows::Zero();
    bool is_over = false;  // learnt, or not to be learnt
  };

  void add(Swing& swing, const LegLinks& links, const Vec3& torque) const;
  void learn(Leg leg, const Swing& swing);

  LinkMassOptions options_;
  double period_;
  int begin_, end_, known_;  // the window's ends, and when it counts [ticks after lift-off]
  double time_ = kNaN;       // of the last tick [s]
  PerLeg<Swing> swings_{};
  Unknowns state_ = Unknowns::Zero();
  Covariance covariance_;
};

}  // namespace surefoot
