#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/sensor_reading.hpp"

#include <array>

namespace surefoot::estimation {

/// When a swing leg of the reference robot is measured, and the noise assumed; others scale with
/// `Scale`.
struct LinkMassOptions {
  bool enabled = true;
  double begin = 0.04;          ///< of the window, after lift-off: before, the foot may touch [s]
  double duration = 0.20;       ///< of the window [s]
  double wait = 0.05;           ///< a window counts after so long without a touchdown [s]
  double usual_share = 0.09;    ///< error of a link's mass, rms
  double usual_delay = 0.0025;  ///< between sampling torques and angles, rms [s]
  double noise = 0.04;          ///< of a window's mean torque [N·m]
  double most_sigmas = 4.0;     ///< rms; a swing that fits worse was disturbed
};

/// Estimates the masses of the legs' links from swing legs.
///
/// With link masses larger than modelled by shares s_l, and torques sampled d later than angles,
/// a free leg satisfies, for each weight φ that is 0 at both ends of a window of length T
/// (integrated by parts: needs no acceleration, of joints or base),
///
///     ∫ φ τ_j dt + d ∫ φ̇ τ_j dt = −Σ_l (1 + s_l) ∫ (φ̇ momentum_jl + φ free_rate_jl) dt
///
/// (LegLinks), for φ = 2/T sin²(πt/T) cos(nπt/T), n = 0, 1, 2. Recursive least squares, with a
/// prior at 0, gives the shares and d. Ours (decision 0019), after the weighted integrals of
/// modulating functions (Shinbrot 1954). Does not allocate.
class LinkMassEstimator {
 public:
  using Shares = LegJointVector;

  /// `period` of the control loop [s], `scale` of the robot.
  LinkMassEstimator(const LinkMassOptions& options, double period, const Scale& scale = {},
                    int num_legs = kNumLegs);

  /// A tick at `time` [s]: `stands`: the feet in contact; `torque`: measured [N·m]. A swing with a
  /// missed tick is ignored.
  void update(double time, const model::Dynamics& dynamics, const PerLeg<bool>& stands,
              const JointVector& torque) noexcept;

  /// Extra mass of each link as a share of its modelled mass, within ±0.5: LF hip, thigh, shank,
  /// RF …
  [[nodiscard]] Shares shares() const;
  /// Delay of the torque samples behind the angles [s].
  [[nodiscard]] double delay() const { return state_[num_links_]; }

 private:
  static constexpr int kMaxUnknowns = kJointsPerLeg * kMaxLegs + 1;
  static constexpr int kNumWeights = 3;
  static constexpr int kNumRows = kNumWeights * kJointsPerLeg;
  using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxUnknowns, 1>;
  using Covariance = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor,
                                   kMaxUnknowns, kMaxUnknowns>;
  using Rows = Eigen::Matrix<double, kNumRows, 1>;

  /// The integrals of a swing so far; a row for each weight and joint.
  struct Swing {
    int ticks = 0;  // in the air
    Eigen::Matrix<double, kNumRows, kJointsPerLeg> links =
        Eigen::Matrix<double, kNumRows, kJointsPerLeg>::Zero();
    Rows torque = Rows::Zero(), torque_slope = Rows::Zero();
    bool is_over = false;  // used, or not usable
  };

  void add(Swing& swing, const model::LegLinks& links, const Vec3& torque) const;
  void learn(Leg leg, const Swing& swing);

  LinkMassOptions options_;  // of this robot
  double period_;
  int num_links_;
  int begin_, end_, known_;  // the window, and when it counts [ticks after lift-off]
  double time_ = kNaN;       // of the last tick [s]
  PerLeg<Swing> swings_{};
  Unknowns state_;
  Covariance covariance_;
};

}  // namespace surefoot::estimation
