#pragma once

#include "surefoot/model/collision_shapes.hpp"
#include "surefoot/model/urdf.hpp"

#include <vector>

namespace surefoot::doctor {

/// The vertices of a shape's mesh in its own axes, to scale [m]; none if its file can't be read.
[[nodiscard]] std::vector<Vec3> mesh_vertices(const model::CollisionShape& shape,
                                              const model::Urdf& urdf);

}  // namespace surefoot::doctor
