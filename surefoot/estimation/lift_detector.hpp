#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/per_leg.hpp"

namespace surefoot::estimation {

/// Distinguishes a lifted robot from one that stands and from one that falls.
///
/// The sensed specific force, as a share of g, is the load on the feet plus any other support, as
/// shares of the weight:
///
///     |a| / g  =  |Σ f_k + F| / (m g)
///
/// With Σ |f_k| < m g / 2 the robot is *lifted* if it senses half of g more than that, and *falls*
/// otherwise. Magnitudes are added, so that wrong joint torques, which cancel in the sum, still
/// count. It is *down* again when most of its weight is on more than half of its feet. Forces and
/// acceleration pass the same filter (20 ms), so that neither leads. Does not allocate.
class LiftDetector {
 public:
  /// `period` of the control loop [s], `scale` of the robot; times below are of scale 1.
  explicit LiftDetector(double period, Scale scale = {}) : period_(period), scale_(scale) {}

  /// One tick: the robot's weight and the estimated ground forces on its feet, in W [N]; the
  /// accelerometer's reading [m/s²]. With a missing number nothing changes.
  void update(double weight, const PerLeg<Vec3>& foot_force, const Vec3& accelerometer) noexcept;

  /// The feet carry little now, yet the robot does not fall.
  [[nodiscard]] bool seems_lifted() const { return lifted_for_ > 0.0; }
  /// It has seemed lifted for 50 ms.
  [[nodiscard]] bool is_lifted() const;
  /// Is a foot on the ground, by its force?
  [[nodiscard]] bool bears(Leg leg) const;
  /// The feet have carried the robot for 0.3 s.
  [[nodiscard]] bool is_down() const;

 private:
  [[nodiscard]] bool is_held() const;
  [[nodiscard]] bool feet_bear() const;

  double period_;
  Scale scale_;
  bool begun_ = false;
  PerLeg<Vec3> share_ = per_leg<Vec3>(Vec3::Zero());  // of the weight
  Vec3 specific_force_ = Vec3::Zero();                // [g]
  double lifted_for_ = 0.0;                           // [s]
  double down_for_ = 0.0;                             // [s]
};

}  // namespace surefoot::estimation
