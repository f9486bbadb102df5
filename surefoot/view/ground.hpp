#pragma once

#include "surefoot/logging/log_header.hpp"

#include <vector>

namespace surefoot::report {

/// The ground at a place, seen from above.
struct GroundPoint {
  int face = -1;    ///< which face of which piece; the same within a smooth patch, −1: no ground
  double z = kNaN;  ///< [m]
  Vec2 slope = Vec2::Zero();  ///< ∂z/∂x, ∂z/∂y
};

/// The simulated ground of a run.
class Ground {
 public:
  explicit Ground(std::vector<LogTerrain> pieces) : pieces_(std::move(pieces)) {}

  [[nodiscard]] bool known() const { return !pieces_.empty(); }
  /// The highest piece there.
  [[nodiscard]] GroundPoint at(const Vec2& p) const;

 private:
  std::vector<LogTerrain> pieces_;
};

}  // namespace surefoot::report
