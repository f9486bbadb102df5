#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/signals/leg.hpp"

namespace surefoot::estimation {

/// Plane through the latest footholds: z = a x + b y + c by least squares (Gehring 2015; the
/// paper's control frame). The points are sphere centres, so the plane lies one foot radius above
/// the ground.
struct TerrainPlane {
  Vec3 normal = Vec3::UnitZ();  ///< unit, upward, in W
  Vec3 point = Vec3::Zero();    ///< mean of the footholds, in W [m]

  /// Height of the plane over (x, y) [m].
  [[nodiscard]] double height(const Vec2& xy) const {
    return point.z() -
           (normal.x() * (xy.x() - point.x()) + normal.y() * (xy.y() - point.y())) / normal.z();
  }
};

/// Fits the plane. A direction in which the feet nearly coincide (second moment below (2 cm)²,
/// of the reference robot) counts as level, and `max_tilt` [rad] limits the tilt, so that the
/// normal always exists.
[[nodiscard]] TerrainPlane fit_terrain_plane(const PerLeg<Vec3>& footholds, double max_tilt,
                                             const Scale& scale = {});

/// Rotation R_WC of the control frame: z along the normal, x the heading projected onto the plane.
[[nodiscard]] Mat3 control_frame(const Vec3& normal, double yaw);

}  // namespace surefoot::estimation
