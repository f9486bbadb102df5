#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/recent.hpp"
#include "surefoot/signals/user_command.hpp"

#include <array>

namespace surefoot::gaits {

/// Footholds: the nominal stance moves with the commanded velocity; hind feet step in the front
/// feet's prints, at their heights.
class FootholdPlanner {
 public:
  /// `scale` of the robot.
  FootholdPlanner(const StanceOptions& stance, const FootholdOptions& options,
                  const Scale& scale = {})
      : stance_(stance), options_(options), length_(scale.length) {}

  void use(const StanceOptions& stance, const FootholdOptions& options) {
    stance_ = stance;
    options_ = options;
  }

  /// Foothold in W [m] of a leg that lifts off from `footholds[leg]`, with a gait cycle of
  /// `cycle_duration` [s]. In a steady walk the feet stand ±1/8 and ±3/8 of a stride from their
  /// nominal places, so the next foot lands 5/8 of a stride ahead of its nominal place.
  [[nodiscard]] Vec3 foothold(Leg leg, const PerLeg<Vec3>& footholds,
                              const estimation::TerrainPlane& plane, double yaw,
                              const UserCommand& user, double cycle_duration) const;

  /// Expected height of the ground at a place, in W [m]: the plane's, for a front leg at most that
  /// of the highest foot continued with the slope of its last stride. A stride steeper than any
  /// slope crossed an edge, beyond which level ground is expected. An estimate that is too low
  /// leads to an early contact; one that is too high makes the torso come down.
  [[nodiscard]] double expected_height(Leg leg, const Vec2& place, const PerLeg<Vec3>& footholds,
                                       const estimation::TerrainPlane& plane) const;

  /// A foot has landed here; stores a front foot's print.
  void remember(Leg leg, const Vec3& p_WF);
  /// Deletes all prints and voids.
  void forget();
  /// Deletes this foot's last print, where there was no ground.
  void forget_last(Leg leg);
  /// A foot found no ground here within its reach: footholds keep `void_radius` away for the next
  /// kAvoidedFor touchdowns.
  void avoid(const Vec3& p_WF);

 private:
  using Prints = Recent<Vec3, 12>;
  struct Void {
    Vec2 place{0.0, 0.0};
    std::size_t until = 0;  // touchdowns
  };
  static constexpr std::size_t kAvoidedFor = 24;  // touchdowns

  [[nodiscard]] const Prints& prints(Leg leg) const { return prints_[is_left(leg) ? 0 : 1]; }
  [[nodiscard]] Prints& prints(Leg leg) { return prints_[is_left(leg) ? 0 : 1]; }
  /// |Δz| / |Δ(x, y)| of a front foot's last stride; 0 over an edge, infinite before the first.
  [[nodiscard]] double last_slope(const Prints& prints) const;
  [[nodiscard]] Vec2 limit_stretch(Leg leg, const Vec2& goal, const PerLeg<Vec3>& footholds,
                                   const Vec2& heading) const;
  [[nodiscard]] Vec3 step_toward(const Vec3& print, const Vec3& from) const;
  [[nodiscard]] Vec3 on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                               const Vec2& heading) const;
  [[nodiscard]] bool is_void(const Vec2& place) const;
  /// The place, or if it is a void, another one within the foot's reach.
  [[nodiscard]] Vec3 avoid_voids(Leg leg, const Vec3& place, const PerLeg<Vec3>& footholds,
                                 const estimation::TerrainPlane& plane, const Vec2& heading) const;

  StanceOptions stance_;
  FootholdOptions options_;
  double length_;                 // scale of lengths
  std::array<Prints, 2> prints_;  // of the front feet: left, right
  Recent<Void, 8> voids_;
  std::size_t touchdowns_ = 0;
};

}  // namespace surefoot::gaits
