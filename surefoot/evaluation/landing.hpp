#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/math/types.hpp"

#include <functional>

namespace surefoot::evaluation {

/// Height of the terrain under (x, y) in S [m]; NaN without terrain.
using TerrainHeight = std::function<double(double x, double y)>;

/// Does a foot that touches at `point` with contact normal `normal` (both in S) stand on an edge?
/// True if within 2 cm of the point the terrain ends or jumps by more than 1.5 cm between places 4
/// mm apart (more than a slope of 75°), or the normal deviates by more than 15° from the terrain's.
/// Lengths are the reference robot's: `Scale`.
[[nodiscard]] bool is_edge_landing(const TerrainHeight& terrain, const Vec3& point,
                                   const Vec3& normal, const Scale& scale = {});

}  // namespace surefoot::evaluation
