#pragma once

#include "surefoot/view/axes.hpp"
#include "surefoot/view/ground.hpp"

namespace surefoot::report {

/// The ground from above, in a frame of x and y in W: lower ground darker, edges as strong lines,
/// creases as weak ones, contour lines where it slopes, and the height of level ground.
void draw_ground(plot::Svg& svg, const plot::Frame& frame, const Ground& ground);

}  // namespace surefoot::report
