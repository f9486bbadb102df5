#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// Tells a robot that something else than its feet holds from one that stands, and from one that
/// falls.
///
/// What a robot feels, as a share of g, is what its feet bear, as a share of its weight, and what
/// holds it beside them:
///
///     |a| / g  =  |Σ f_k + F| / (m g)
///
/// so with little on its feet, Σ |f_k| < m g / 2, it is *lifted* where it feels half of g more than
/// that, and *falls* where it doesn't. Sizes are added, so that forces which only cancel, as those
/// by wrong joint torques do, are forces. It is *down* again when most of its weight is on three
/// feet or more. Forces and acceleration go through the same filter (20 ms), so that none is ahead
/// of the other. Does not allocate.
class LiftDetector {
 public:
  /// `period` of the control loop [s].
  explicit LiftDetector(double period) : period_(period) {}

  /// One tick: the robot's weight and estimated forces of the ground on its feet, in W [N]; what
  /// the accelerometer gives [m/s²]. Where a number is missing nothing changes.
  void update(double weight, const PerLeg<Vec3>& foot_force, const Vec3& accelerometer) noexcept;

  /// Its feet bear little now, and yet the robot does not fall.
  [[nodiscard]] bool seems_lifted() const { return lifted_for_ > 0.0; }
  /// … for 50 ms.
  [[nodiscard]] bool is_lifted() const;
  /// Is a foot on the ground, by its force?
  [[nodiscard]] bool bears(Leg leg) const;
  /// The feet bear the robot, for 0.3 s.
  [[nodiscard]] bool is_down() const;

 private:
  [[nodiscard]] bool is_held() const;
  [[nodiscard]] bool feet_bear() const;

  double period_;
  bool begun_ = false;
  PerLeg<Vec3> share_{};      // of the weight, on each foot
  Vec3 felt_ = Vec3::Zero();  // [g]
  double lifted_for_ = 0.0;   // [s]
  double down_for_ = 0.0;     // [s]
};

}  // namespace surefoot
