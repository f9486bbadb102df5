#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/signals/user_command.hpp"

#include <array>

namespace surefoot {

/// Foot of the nominal stance relative to the stance's centre, in heading axes [m].
[[nodiscard]] Vec2 nominal_offset(const StanceOptions& stance, Leg leg);

/// What strides are limited by, beside the options of the footholds.
struct StrideLimits {
  double reach = 0.0;   ///< of a foot from its hip, horizontally [m]
  double length = 0.0;  ///< that a swing can do in its time [m]
};

/// Where the next foot goes: the nominal stance carried along with the commanded velocity; hind
/// feet take the footprints that the front feet found, heights included.
class FootholdPlanner {
 public:
  FootholdPlanner(const StanceOptions& stance, const FootholdOptions& options)
      : stance_(stance), options_(options) {}

  /// Foothold of a leg that lifts off from `footholds[leg]`, with the gait's full cycle lasting
  /// `cycle_duration`. In a steady walk the feet stand ±1/8 and ±3/8 of a stride about their
  /// nominal places, so the foot that goes next lands 5/8 of a stride ahead of the place of its
  /// centre.
  [[nodiscard]] Vec3 foothold(Leg leg, const PerLeg<Vec3>& footholds, const TerrainPlane& plane,
                              double yaw, const UserCommand& user, double cycle_duration) const;

  /// Height at which a leg is to find ground at a place: the plane's, for a front leg no further
  /// above all feet than its last stride's slope leads. A stride steeper than any slope went over
  /// an edge, and behind an edge the ground is taken as level. (Ground that lies higher than
  /// expected is met early; for ground that lies lower the torso must come down.)
  [[nodiscard]] double expected_height(Leg leg, const Vec2& place, const PerLeg<Vec3>& footholds,
                                       const TerrainPlane& plane) const;

  /// Share of the commanded velocity, at most 1, that the strides of all legs allow. A foot makes
  /// one step a cycle, so its stride is velocity × cycle:
  ///
  ///     (stride_x / longest)² + (stride_y / aside)² ≤ 1
  ///
  /// with `aside` at most `max_side_step` and `max_side_stride`, `longest` at most `max_step`,
  /// `max_stride`, `limits.length`, and twice the way from the foot's nominal place to
  /// `limits.reach` from the hip. Hips are about the torso's centre, in heading axes.
  [[nodiscard]] double feasible_share(const UserCommand& user, const PerLeg<Vec2>& hips,
                                      const StrideLimits& limits, double cycle_duration) const;

  /// Height of the hips over the feet up to which legs of a length, from hip to foot, reach both
  /// ends of the strides, half of each before and behind the foot's nominal place, while the hips
  /// sway [m].
  [[nodiscard]] double tallest(const UserCommand& user, const PerLeg<Vec2>& hips, double length,
                               double cycle_duration) const;

  /// Share of a yaw rate, at most 1, that feet which stand allow until they step. In a steady turn
  /// the heading is up to 0.15 cycles of the turn ahead of the feet, and they are up to 3/8 of
  /// their stride aside of their nominal places. It is 0 where the heading is twice as far ahead,
  /// or a foot that it leaves behind half as far again.
  [[nodiscard]] double turning_share(double yaw_rate, const PerLeg<Vec3>& footholds,
                                     const PerLeg<bool>& down, double yaw,
                                     double cycle_duration) const;

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
  static constexpr std::size_t kPrintsKept = 12;
  static constexpr std::size_t kVoidsKept = 8;
  static constexpr std::size_t kAvoidedFor = 24;  // touchdowns; then it may be tried again
  /// Of one front foot, the newest kPrintsKept.
  struct Prints {
    [[nodiscard]] std::size_t size() const { return kept; }
    /// i = 0: the last one.
    [[nodiscard]] const Vec3& newest(std::size_t i) const {
      return points[(added - 1 - i) % kPrintsKept];
    }
    void add(const Vec3& p_WF);
    void drop_last();

    std::array<Vec3, kPrintsKept> points{};
    std::size_t added = 0, kept = 0;
  };
  /// |Δz| / |Δ(x, y)| of a side's front foot's last stride; 0 over an edge, infinite before there
  /// was one.
  [[nodiscard]] double last_slope(const Prints& prints) const;
  [[nodiscard]] Vec2 not_stretched(Leg leg, const Vec2& goal, const PerLeg<Vec3>& footholds,
                                   const Vec2& heading) const;
  /// How far the foot that stands furthest back in a turn to a side, 1 or −1, is aside of its
  /// nominal place [m].
  [[nodiscard]] double left_behind(double side, const PerLeg<Vec3>& footholds,
                                   const PerLeg<bool>& down, double yaw) const;
  /// Of a leg, in heading axes [m].
  [[nodiscard]] Vec2 stride(Leg leg, const UserCommand& user, double cycle_duration) const;
  [[nodiscard]] Vec3 towards(const Vec3& print, const Vec3& from) const;
  /// Do three prints, one behind the other, lie on one slope?
  [[nodiscard]] bool is_slope(const Vec3& first, const Vec3& second, const Vec3& third) const;
  [[nodiscard]] Vec3 on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                               const Vec2& heading) const;
  [[nodiscard]] bool is_void(const Vec2& place) const;
  /// The place, or where it is known that there is no ground, another one that the foot can reach.
  [[nodiscard]] Vec3 beside_voids(Leg leg, const Vec3& place, const PerLeg<Vec3>& footholds,
                                  const TerrainPlane& plane, const Vec2& heading) const;

  StanceOptions stance_;
  FootholdOptions options_;
  std::array<Prints, 2> prints_{};  // left, right
  struct Void {
    Vec2 place = Vec2::Zero();
    std::size_t until = 0;  // touchdowns
  };
  std::array<Void, kVoidsKept> voids_{};
  std::size_t num_voids_ = 0;  // ever added; the newest kVoidsKept are kept
  std::size_t touchdowns_ = 0;
};

}  // namespace surefoot
