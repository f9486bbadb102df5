#pragma once

#include "surefoot/estimation/terrain_plane.hpp"
#include "surefoot/planning/planner_options.hpp"
#include "surefoot/signals/user_command.hpp"

#include <array>

namespace surefoot {

/// Foot of the nominal stance relative to the stance's centre, in heading axes [m].
[[nodiscard]] Vec2 nominal_offset(const StanceOptions& stance, Leg leg);

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

  /// A front foot has found ground here.
  void remember(Leg leg, const Vec3& p_WF);

 private:
  static constexpr std::size_t kPrintsKept = 12;
  struct Prints {
    std::array<Vec3, kPrintsKept> points{};
    std::size_t count = 0;  // ever added; the newest kPrintsKept are kept
  };
  [[nodiscard]] Vec3 on_prints(const Prints& prints, const Vec3& nominal, const Vec3& from,
                               const Vec2& heading) const;

  StanceOptions stance_;
  FootholdOptions options_;
  std::array<Prints, 2> prints_{};  // left, right
};

}  // namespace surefoot
