#pragma once

#include "surefoot/view/axes.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot::plot {

/// A curve over time.
struct Curve {
  std::string label;  ///< in the legend; empty: none
  std::string style;  ///< CSS classes, e.g. "line c1 dashed"
  std::vector<double> y;
};

/// A stretch of time that is shaded.
struct Span {
  double from = 0.0, to = 0.0;
  std::string style;
};

/// A horizontal line that bounds the curves.
struct Bound {
  double y = 0.0;
  std::string label;
};

/// One plot of a figure.
struct Panel {
  std::string title = {};
  std::string note = {};     ///< at the right, where a legend would stand
  std::string y_label = {};  ///< with unit
  std::vector<Curve> curves = {};
  std::vector<Span> spans = {};
  std::vector<Bound> bounds = {};
  double height = 120.0;   ///< [px]
  bool from_zero = false;  ///< the axis begins at 0
  Range y_range = {};      ///< shown; empty: fits curves and bounds
};

/// Plots one above the other with the same time axis.
struct TimeFigure {
  std::string description;
  std::string x_label = "time [s]";
  std::vector<double> x;                ///< of all curves
  Range x_range = {};                   ///< shown; empty: all of x
  std::vector<Range> calibration = {};  ///< times in which the robot calibrates itself
  std::vector<Panel> panels;
};

inline constexpr double kFigureWidth = 880.0, kLeftMargin = 68.0, kRightMargin = 16.0;

[[nodiscard]] std::string draw(const TimeFigure& figure);

/// A bar along the upper edge of a plot over time, and what it stands for.
void draw_calibration(Svg& svg, const Frame& frame, const std::vector<Range>& times,
                      bool with_words);

/// A row of samples with names, flush right at `right`.
struct LegendEntry {
  std::string label, style;
};
void draw_legend(Svg& svg, double right, double y, const std::vector<LegendEntry>& entries);

}  // namespace surefoot::plot
