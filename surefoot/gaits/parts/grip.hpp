#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/signals/robot_state.hpp"

namespace surefoot::gaits {

/// What friction each foot is believed to find: the configured one until it slides, then
///
///     μ_k ← min(μ_k, max(μ_min, share |f_t| / f_n))
///
/// for as long as it does, with the estimated forces about the normal of its friction pyramid;
/// afterwards it comes back at a constant rate.
class Grip {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  Grip(const GripOptions& options, double friction, double period, const Scale& scale = {})
      : options_(options), period_(period), scale_(scale) {
    expect(friction);
  }

  /// Every foot is believed to find this from now on, until it slides.
  void expect(double friction) {
    configured_ = friction;
    friction_.fill(friction);
  }

  /// One tick. True if a foot began or ceased to slide: it stands elsewhere than it did.
  bool update(const RobotState& state, const PerLeg<Vec3>& normals_W);

  [[nodiscard]] double friction(Leg leg) const { return friction_[index(leg)]; }
  /// Of the feet that stand, in the mean.
  [[nodiscard]] double mean_friction(const PerLeg<bool>& stands) const;
  /// Did a foot begin to slide at this tick?
  [[nodiscard]] bool began() const { return std::ranges::find(began_, true) != began_.end(); }
  [[nodiscard]] bool began(Leg leg) const { return began_[index(leg)]; }
  /// How much slower than usual the walk should be: 1 while every foot has enough friction.
  [[nodiscard]] double caution() const;

 private:
  void adapt(double& friction, const Vec3& force, const Vec3& normal_W) const;

  GripOptions options_;
  double configured_ = 0.0, period_;
  Scale scale_;
  PerLeg<double> friction_{};
  PerLeg<bool> slid_{}, began_{};
};

}  // namespace surefoot::gaits
