#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/recent.hpp"
#include "surefoot/signals/user_command.hpp"

#include <array>

namespace surefoot::gaits {

/// Where the next foot goes: the nominal stance carried along with the commanded velocity; hind
/// feet take the footprints that the front feet found, heights included.
class FootholdPlanner {
 public:
  /// `scale` of the robot.
  FootholdPlanner(const StanceOptions& stance, const FootholdOptions& options,
                  const Scale& scale = {})
      : stance_(stance), options_(options), length_(scale.length) {}

  /// Foothold of a leg that lifts off from `footholds[leg]`, with the gait's full cycle lasting
  /// `cycle_duration`. In a steady walk the feet stand ±1/8 and ±3/8 of a stride about their
  /// nominal places, so the foot that goes next lands 5/8 of a stride ahead of the place of its
  /// centre.
  [[nodiscard]] Vec3 foothold(Leg leg, const PerLeg<Vec3>& footholds,
                              const estimation::TerrainPlane& plane, double yaw,
                              const UserCommand& user, double cycle_duration) const;

  /// Height at which a leg is to find ground at a place: the plane's, for a front leg no further
  /// above all feet than its last stride's slope leads. A stride steeper than any slope went over
  /// an edge, and behind an edge the ground is taken as level. (Ground that lies higher than
  /// expected is met early; for ground that lies lower the torso must come down.)
  [[nodiscard]] double expected_height(Leg leg, const Vec2& place, const PerLeg<Vec3>& footholds,
                                       const estimation::TerrainPlane& plane) const;

  /// A foot has found ground here: a front foot's print.
  void remember(Leg leg, const Vec3& p_WF);
  /// All prints and voids.
  void forget();
  /// There was none where this foot came down last.
  void forget_last(Leg leg);
  /// A foot that was to stand here found no ground within its reach: for the next kAvoidedFor
  /// touchdowns footholds keep `void_radius` away, and another place is taken instead.
  void avoid(const Vec3& p_WF);

 private:
  using Prints = Recent<Vec3, 12>;
  struct Void {
    Vec2 place{0.0, 0.0};
    std::size_t until = 0;  // touchdowns
  };
  static constexpr std::size_t kAvoidedFor = 24;  // touchdowns; then it may be tried again

  [[nodiscard]] const Prints& prints(Leg leg) const { return prints_[is_left(leg) ? 0 : 1]; }
  [[nodiscard]] Prints& prints(Leg leg) { return prints_[is_left(leg) ? 0 : 1]; }
  /// |Δz| / |Δ(x, y)| of a side's front foot's last stride; 0 over an edge, infinite before there
  /// was one.
  [[nodiscard]] double last_slope(const Prints& prints) const;
  [[nodiscard]] Vec2 not_stretched(Leg leg, const Vec2& goal, const PerLeg<Vec3>& footholds,
                                   const Vec2& heading) const;
  [[nodiscard]] Vec3 towards(const Vec3& print, const Vec3& from) const;
  [[nodiscard]] Vec3 on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                               const Vec2& heading) const;
  [[nodiscard]] bool is_void(const Vec2& place) const;
  /// The place, or where it is known that there is no ground, another one that the foot can reach.
  [[nodiscard]] Vec3 beside_voids(Leg leg, const Vec3& place, const PerLeg<Vec3>& footholds,
                                  const estimation::TerrainPlane& plane, const Vec2& heading) const;

  StanceOptions stance_;
  FootholdOptions options_;
  double length_;                 // that its lengths go with, as a ratio
  std::array<Prints, 2> prints_;  // of the front feet: left, right
  Recent<Void, 8> voids_;
  std::size_t touchdowns_ = 0;
};

}  // namespace surefoot::gaits
