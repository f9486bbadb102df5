#pragma once

#include "surefoot/gaits/body.hpp"

namespace surefoot {

/// Puts together the phases ahead that the COM is planned through, beginning with the feet as they
/// are. Ends with `plan`.
class ComHorizon {
 public:
  /// `recovers`: the robot has lost its balance and comes to rest.
  ComHorizon(const GaitTick& tick, Body& body, bool recovers);

  /// Goes on by a phase with the feet that are down. See SupportPhase for `must_rest`.
  void add(double duration, bool must_rest);
  /// Support until this leg lifts off.
  void add_support_until_lift_off(Leg leg, double duration);
  /// The foot stands here from now on.
  void land(Leg leg, const Vec3& foothold);

  [[nodiscard]] bool is_down(Leg leg) const { return phase_.down[index(leg)]; }
  [[nodiscard]] const PerLeg<Vec3>& feet() const { return feet_; }

  /// Plans the COM to a velocity at the end, x and y in W [m/s], or to rest there.
  void plan(const Vec2& end_velocity, bool comes_to_rest = false);

 private:
  const GaitTick& tick_;
  Body& body_;
  double ground_;  // under the COM [m]
  PerLeg<Vec3> feet_;
  SupportPhase phase_;
};

}  // namespace surefoot
