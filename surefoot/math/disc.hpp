#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// The point nearest to p within `radius` of a centre.
[[nodiscard]] inline Vec2 nearest_within(const Vec2& p, const Vec2& centre, double radius) {
  const Vec2 from = p - centre;
  return from.norm() > radius ? Vec2(centre + radius / from.norm() * from) : p;
}

}  // namespace surefoot
