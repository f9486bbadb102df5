#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot {
struct Group;
}  // namespace surefoot

namespace surefoot::estimation {

/// When a stance foot counts as sliding.
struct SlipOptions {
  bool enabled = true;
  double begin_speed = 0.06, begin_duration = 0.01, end_speed = 0.04, end_duration = 0.03;
  double force = 20.0, settle = 0.05, cutoff_hz = 60.0;
};

/// Their names, units, ranges and help.
[[nodiscard]] Group fields(SlipOptions& o);

/// Finds sliding stance feet and their speed.
///
///     s_k = (1 − n nᵀ) (v_k − v_others)
///
/// v_k is the velocity of foot k's contact point, zero if it stands or rolls. v_others is the error
/// of the base velocity: along each axis the median over the other stance feet's contact points and
/// 0, the estimate's own vote; with one other foot 0. So neither a wrong base velocity nor another
/// sliding foot makes a foot slide. It slides from `begin_speed` for `begin_duration` until below
/// `end_speed` for `end_duration`, if half of the standing feet don't. Ours. Does not allocate.
class SlipDetector {
 public:
  SlipDetector(const SlipOptions& options, double period);

  /// One tick, after foot forces are known: fills state.slip_velocity and state.slips. `stands`:
  /// the feet planned to carry load; `normal_W`: the terrain's estimate.
  void update(const model::Dynamics& dynamics, const PerLeg<bool>& stands, const Vec3& normal_W,
              RobotState& state) noexcept;

 private:
  struct Foot {
    Vec3 velocity = Vec3::Zero();  // low-passed, in W [m/s]
    double stands_for = 1e3;       // [s]
    double fast_for = 0.0;         // [s]
    double slow_for = 0.0;         // [s]
    bool slips = false;
  };
  [[nodiscard]] PerLeg<bool> settled_feet(const PerLeg<bool>& stands) const;
  void reject_without_rest(const PerLeg<bool>& stands);
  void judge(Foot& foot, const Vec3& velocity, double normal_force) const;

  SlipOptions options_;
  double period_;
  double gain_;
  PerLeg<Foot> feet_{};
};

}  // namespace surefoot::estimation
