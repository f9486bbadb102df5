#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Puts together the phases ahead that the COM is planned through, beginning with the feet as they
/// are. Ends with `plan` or `come_to_rest`.
class ComHorizon {
 public:
  /// `recovers`: the robot has lost its balance and comes to rest.
  ComHorizon(const Situation& now, bool recovers);

  /// Goes on by a phase with the feet that are down. See SupportPhase for `must_rest`.
  void add(double duration, bool must_rest);
  /// Support until this leg lifts off.
  void add_support_until_lift_off(Leg leg, double duration);
  /// The foot stands here from now on.
  void land(Leg leg, const Vec3& foothold);

  [[nodiscard]] bool is_down(Leg leg) const { return phase_.down[index(leg)]; }
  [[nodiscard]] const PerLeg<Vec3>& feet() const { return feet_; }

  /// Plans the COM to a velocity at the end, x and y in W [m/s] …
  void plan(Body& body, const Vec2& end_velocity);
  /// … or over the centre of the feet, to rest there. `duration` is that of the reference robot.
  void come_to_rest(Body& body, double duration = 1.0, bool must_rest = false);

 private:
  double ground_;  // under the COM [m]
  PerLeg<Vec3> feet_;
  SupportPhase phase_;
  ComProblem problem_;
};

}  // namespace surefoot::gaits
