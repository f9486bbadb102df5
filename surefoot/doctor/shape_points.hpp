#pragma once

#include "surefoot/model/collision_shapes.hpp"
#include "surefoot/model/urdf.hpp"

#include <vector>

namespace surefoot::doctor {

/// The outermost points of a shape in its link's frame [m]: corners of a box, rims of a cylinder,
/// rims and tips of a capsule, vertices of a mesh; none of a sphere.
[[nodiscard]] std::vector<Vec3> shape_points(const model::CollisionShape& shape,
                                             const model::Urdf& urdf);

}  // namespace surefoot::doctor
