#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot {

/// When a standing foot counts as sliding.
struct SlipOptions {
  bool enabled = true;
  double begin_speed = 0.06;  ///< of the contact point along the ground, against the others [m/s]
  double begin_duration = 0.01;  ///< … for so long [s]
  double end_speed = 0.04;       ///< below this … [m/s]
  double end_duration = 0.03;    ///< … for so long it stands again [s]
  double force = 20.0;           ///< feet that carry less are not judged [N]
  double settle = 0.05;          ///< nor those that came down more recently [s]
  double cutoff_hz = 60.0;       ///< of the velocity's low pass
};

/// Tells which standing feet slide, and how fast.
///
///     s_k = (1 − n nᵀ) (v_k − v_others)
///
/// v_k is the velocity of foot k's contact point, zero where it stands or rolls. v_others is what
/// the base is believed to move too fast: along each axis the median of the other standing feet's
/// contact points, and of 0, the believed base velocity's own vote. So neither a base velocity that
/// is wrong nor one other foot that slides makes a foot slide. A foot slides from `begin_speed` for
/// `begin_duration` until it has been below `end_speed` for `end_duration`. Two feet must be left
/// that stand still, or none slides. Ours. Does not allocate.
class SlipDetector {
 public:
  SlipDetector(const SlipOptions& options, double period);

  /// One tick, after foot forces are known: fills state.slip_velocity and state.slips. `stands`
  /// says which feet the plan lets carry; `normal_W` is the terrain's as believed.
  void update(const Dynamics& dynamics, const PerLeg<bool>& stands, const Vec3& normal_W,
              RobotState& state) noexcept;

 private:
  struct Foot {
    Vec3 velocity = Vec3::Zero();  // low-passed, in W [m/s]
    double stands_for = 1e3;       // [s]
    double fast_for = 0.0;         // [s]
    double slow_for = 0.0;         // [s]
    bool slips = false;
  };
  void doubt_the_belief(const PerLeg<bool>& stands);
  void judge(Foot& foot, const Vec3& velocity, double normal_force) const;

  SlipOptions options_;
  double period_;
  double gain_;
  PerLeg<Foot> feet_{};
};

}  // namespace surefoot
