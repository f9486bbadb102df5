#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// Estimated friction coefficient of each foot: the configured one until it slides, then
///
///     μ_k ← min(μ_k, max(μ_min, share |f_t| / f_n))
///
/// while it slides, with the estimated forces relative to the normal of its friction pyramid;
/// afterwards it recovers at a constant rate.
class Grip {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  Grip(const GripOptions& options, double friction, double period, const Scale& scale = {},
       int num_legs = kNumLegs)
      : options_(options),
        period_(period),
        scale_(scale),
        friction_(num_legs, friction),
        slid_(num_legs, false),
        began_(num_legs, false) {
    configured_ = friction;
  }

  /// Sets the configured friction coefficient, and that of every foot, whatever the gait.
  void expect(double friction) {
    is_told_ = true;
    configured_ = friction;
    friction_.fill(friction);
  }
  /// Goes on with another gait's options: a higher coefficient recovers as after a slip.
  void use(const GripOptions& options, double friction) {
    options_ = options;
    if (is_told_) return;
    configured_ = friction;
    for (double& foot : friction_) foot = std::min(foot, friction);
  }

  /// One tick. True if a foot began or stopped sliding: its foothold has moved.
  bool update(const RobotState& state, const PerLeg<Vec3>& normals_W);

  [[nodiscard]] double friction(Leg leg) const { return friction_[index(leg)]; }
  /// Mean over the feet that stand.
  [[nodiscard]] double mean_friction(const PerLeg<bool>& stands) const;
  /// Did a foot begin to slide at this tick?
  [[nodiscard]] bool began() const { return std::ranges::find(began_, true) != began_.end(); }
  [[nodiscard]] bool began(Leg leg) const { return began_[index(leg)]; }
  /// Factor ≥ 1 by which the walk should slow down: 1 while every foot has enough friction.
  [[nodiscard]] double caution() const;

 private:
  void adapt(double& friction, const Vec3& force, const Vec3& normal_W) const;

  GripOptions options_;
  double configured_ = 0.0, period_;
  Scale scale_;
  PerLeg<double> friction_;
  PerLeg<bool> slid_, began_;
  bool is_told_ = false;  // the friction, by the user
};

}  // namespace surefoot::gaits
