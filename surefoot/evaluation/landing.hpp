#pragma once

#include "surefoot/math/types.hpp"

#include <functional>

namespace surefoot {

/// Height of the terrain under (x, y) in W [m]; NaN where there is none.
using TerrainHeight = std::function<double(double x, double y)>;

/// True if a foot that touches at `point` with the contact normal `normal` (both in W) stands on an
/// edge: within 2 cm of the point the terrain jumps by more than 1.5 cm between places 4 mm apart
/// (which no slope below 75° does) or ends, or the normal leans by more than 15° from that of the
/// terrain there.
[[nodiscard]] bool is_edge_landing(const TerrainHeight& terrain, const Vec3& point,
                                   const Vec3& normal);

}  // namespace surefoot
