#include "surefoot/view/time_figure.hpp"

#include <algorithm>

namespace surefoot::plot {
namespace {

constexpr double kHead = 24.0;    // above a panel: title and legend
constexpr double kGap = 8.0;      // below it
constexpr double kBottom = 40.0;  // below the last: numbers and label

Range y_range(const Panel& panel) {
  if (!panel.y_range.empty()) return panel.y_range;
  Range range;
  for (const Curve& curve : panel.curves) range.add(curve.y);
  for (const Bound& bound : panel.bounds) range.add(bound.y);
  if (panel.from_zero) range.add(0.0);
  Range padded = range.padded(0.08);
  if (panel.from_zero) padded.low = 0.0;
  return padded;
}

void draw_panel(Svg& svg, const Frame& frame, const Panel& panel, const std::vector<double>& x,
                bool is_last, const std::string& x_label) {
  for (const Span& span : panel.spans) {
    const double from = std::max(span.from, frame.x.low), to = std::min(span.to, frame.x.high);
    svg.rectangle({frame.px_x(from), frame.corner.y}, (to - from) / frame.x.span() * frame.width,
                  frame.height, span.style);
  }
  draw_x_axis(svg, frame, is_last ? x_label : "", is_last);
  draw_y_axis(svg, frame, panel.y_label);
  svg.begin_clip(frame.corner, frame.width, frame.height);
  for (const Bound& bound : panel.bounds) {
    svg.line(frame.at(frame.x.low, bound.y), frame.at(frame.x.high, bound.y), "bound");
  }
  for (const Curve& curve : panel.curves) {
    svg.path(path_through(thinned_curve(frame, x, curve.y)), curve.style, curve.label);
  }
  svg.end_clip();
  for (const Bound& bound : panel.bounds) {
    const double y = frame.px_y(bound.y);
    const bool near_top = y < frame.corner.y + 14.0;
    if (bound.label.empty()) continue;
    svg.text({frame.corner.x + frame.width - 6.0, near_top ? y + 13.0 : y - 4.0}, bound.label,
             "note", Anchor::end);
  }
  outline(svg, frame);
  svg.text({frame.corner.x, frame.corner.y - 7.0}, panel.title, "panel-title");
  svg.text({frame.corner.x + frame.width, frame.corner.y - 7.0}, panel.note, "note", Anchor::end);
  std::vector<LegendEntry> legend;
  for (const Curve& curve : panel.curves) {
    if (!curve.label.empty()) legend.push_back({curve.label, curve.style});
  }
  if (legend.size() > 1)
    draw_legend(svg, frame.corner.x + frame.width, frame.corner.y - 7.0, legend);
}

}  // namespace

std::string draw(const TimeFigure& figure) {
  double height = kBottom - kGap;
  for (const Panel& panel : figure.panels) height += kHead + panel.height + kGap;
  Svg svg(kFigureWidth, height);
  Range x = figure.x_range;
  if (x.empty()) x.add(figure.x);
  double y = 0.0;
  for (const Panel& panel : figure.panels) {
    const Frame frame{.corner = {kLeftMargin, y + kHead},
                      .width = kFigureWidth - kLeftMargin - kRightMargin,
                      .height = panel.height,
                      .x = x.padded(0.0),
                      .y = y_range(panel)};
    draw_panel(svg, frame, panel, figure.x, &panel == &figure.panels.back(), figure.x_label);
    draw_calibration(svg, frame, figure.calibration, &panel == &figure.panels.front());
    y += kHead + panel.height + kGap;
  }
  return svg.image(figure.description);
}

void draw_calibration(Svg& svg, const Frame& frame, const std::vector<Range>& times,
                      bool with_words) {
  constexpr double kThick = 4.0;
  for (const Range& time : times) {
    const double from = frame.px_x(std::max(time.low, frame.x.low)),
                 to = frame.px_x(std::min(time.high, frame.x.high));
    if (to > from) svg.rectangle({from, frame.corner.y}, to - from, kThick, "calibration");
    if (to - from > text_width("calibrates") && with_words)
      svg.text({to - 4.0, frame.corner.y + 16.0}, "calibrates", "note", Anchor::end);
  }
}

void draw_legend(Svg& svg, double right, double y, const std::vector<LegendEntry>& entries) {
  constexpr double kSample = 22.0, kSpace = 16.0;
  double x = right;
  for (const LegendEntry& entry : entries) x -= kSample + 5.0 + text_width(entry.label) + kSpace;
  x += kSpace;
  for (const LegendEntry& entry : entries) {
    svg.line({x, y - 4.0}, {x + kSample, y - 4.0}, entry.style);
    svg.text({x + kSample + 5.0, y}, entry.label, "legend");
    x += kSample + 5.0 + text_width(entry.label) + kSpace;
  }
}

}  // namespace surefoot::plot
