#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Builds the phases of a COM plan, beginning with the present contacts. Ends with `plan` or
/// `come_to_rest`.
class ComHorizon {
 public:
  /// `recovers`: the robot comes to rest after a loss of balance.
  ComHorizon(const Situation& now, bool recovers);

  /// Adds a phase with the present contacts. See SupportPhase for `must_rest`.
  void add(double duration, bool must_rest);
  /// Adds a phase that ends with this leg's lift-off.
  void add_support_until_lift_off(Leg leg, double duration);
  /// Adds this foot's contact to the phases that follow.
  void land(Leg leg, const Vec3& foothold);

  [[nodiscard]] bool is_down(Leg leg) const { return phase_.down[index(leg)]; }
  [[nodiscard]] const PerLeg<Vec3>& feet() const { return feet_; }

  /// Plans the COM to a velocity at the end, x and y in W [m/s].
  void plan(Body& body, const Vec2& end_velocity);
  /// Plans the COM to rest over the centre of the feet. `duration` [s] at scale 1.
  void come_to_rest(Body& body, double duration = 1.0, bool must_rest = false);

 private:
  double ground_;  // under the COM [m]
  PerLeg<Vec3> feet_;
  SupportPhase phase_{static_cast<int>(feet_.size())};
  ComProblem problem_;
};

}  // namespace surefoot::gaits
