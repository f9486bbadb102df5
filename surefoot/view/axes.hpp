#pragma once

#include "surefoot/view/svg.hpp"

#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::plot {

/// An interval of values; empty until something was added.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value);  ///< NaN is ignored
  void add(const std::vector<double>& values);
  [[nodiscard]] bool empty() const { return !(low <= high); }
  [[nodiscard]] double span() const { return high - low; }
  /// With a margin of that share on both sides; never of zero width.
  [[nodiscard]] Range padded(double share) const;
};

struct Tick {
  double value = 0.0;
  std::string label;
};

/// About `count` round values (1, 2 or 5 × 10ⁿ apart) inside the range, all with the same decimals.
[[nodiscard]] std::vector<Tick> ticks(const Range& range, int count);

/// A rectangle of the image that shows a rectangle of values.
struct Frame {
  Point corner;  ///< upper left [px]
  double width = 0.0, height = 0.0;
  Range x, y;

  [[nodiscard]] double px_x(double value) const {
    return corner.x + (value - x.low) / x.span() * width;
  }
  [[nodiscard]] double px_y(double value) const {
    return corner.y + (y.high - value) / y.span() * height;
  }
  [[nodiscard]] Point at(double value_x, double value_y) const {
    return {px_x(value_x), px_y(value_y)};
  }
};

/// Grid, ticks with labels and the axis' name; the frame's outline is drawn by `outline`.
void draw_x_axis(Svg& svg, const Frame& frame, std::string_view label, bool with_numbers = true);
void draw_y_axis(Svg& svg, const Frame& frame, std::string_view label);
void outline(Svg& svg, const Frame& frame);

/// Screen points of a curve with as few points as show the same picture: per pixel column first,
/// lowest, highest and last value, then without those that lie within a fifth of a pixel of the
/// line between others.
[[nodiscard]] std::vector<Point> thinned_curve(const Frame& frame, const std::vector<double>& x,
                                               const std::vector<double>& y);

}  // namespace surefoot::plot
