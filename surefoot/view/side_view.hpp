#pragma once

#include "surefoot/view/axes.hpp"
#include "surefoot/view/run_data.hpp"

#include <cstddef>
#include <vector>

namespace surefoot::report {

/// A place where a foot came down.
struct Footprint {
  std::size_t leg = 0;
  double time = 0.0;
  Vec3 p;  ///< of the foot sphere's centre in W [m]
};
[[nodiscard]] std::vector<Footprint> footprints(const RunData& run);

/// The frame of the view from the side (x and z in W) under one from above: the same x, the same
/// scale along both axes, its upper edge at `top`.
[[nodiscard]] plot::Frame side_frame(const RunData& run, const plot::Frame& above, double top);

/// Paths of the feet's lowest points, of base and centre of mass, over the ground under the left
/// and the right feet.
void draw_side(plot::Svg& svg, const plot::Frame& frame, const RunData& run,
               const std::vector<Footprint>& prints);

}  // namespace surefoot::report
