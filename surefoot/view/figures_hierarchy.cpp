#include "surefoot/logging/visible_residual.hpp"
#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

// How the levels of the hierarchy came out.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Svg;

constexpr double kRowHeight = 27.0, kNames = 205.0, kMaxima = 118.0, kHead = 24.0;

bool never_zero(const std::string& task) { return std::isnan(visible_residual(task, "")); }

/// Where a tick solved nothing there is no curve: 0.
std::vector<double> residuals(const RunData& run, std::size_t level) {
  std::vector<double> result;
  for (const TickSample& tick : run.ticks) result.push_back(std::fmax(tick.residuals[level], 0.0));
  return result;
}

// The curve from 0 to its own largest value, filled; level ground where it is zero throughout.
void draw_curve(Svg& svg, Frame frame, const RunData& run, const std::vector<double>& values,
                const char* style) {
  const double largest = *std::ranges::max_element(values);
  if (!(largest > kResidualRounding)) return;
  frame.y = {0.0, 1.06 * largest};
  std::vector<double> times;
  for (const TickSample& tick : run.ticks) times.push_back(tick.time);
  std::vector<plot::Point> points = plot::thinned_curve(frame, times, values);
  points.insert(points.begin(), frame.at(times.front(), 0.0));
  points.push_back(frame.at(times.back(), 0.0));
  svg.path(plot::path_through(points), style);
}

void draw_level(Svg& svg, const Frame& frame, const RunData& run, std::size_t level) {
  const auto number = static_cast<std::ptrdiff_t>(level);
  const std::string task = run.header.level_name(number), unit = run.header.level_unit(number);
  const bool restless = never_zero(task);
  const std::vector<double> values = residuals(run, level);
  const double largest = *std::ranges::max_element(values);
  draw_curve(svg, frame, run, values, restless ? "area restless" : "area");
  const double bottom = frame.corner.y + frame.height;
  svg.line({frame.corner.x, bottom}, {frame.corner.x + frame.width, bottom}, "grid");
  std::string words = task;
  std::replace(words.begin(), words.end(), '_', ' ');
  svg.text({kNames - 8.0, bottom - 7.0}, std::to_string(level + 1) + "  " + words, "tick",
           plot::Anchor::end);
  const std::string size = largest > kResidualRounding
                               ? plot::two_digits(largest) + (unit.empty() ? "" : " " + unit)
                               : "0";
  svg.text({frame.corner.x + frame.width + 8.0, bottom - 7.0}, size + (restless ? "  *" : ""),
           largest > kResidualRounding ? "label" : "tick");
}

}  // namespace

std::string residual_figure(const RunData& run) {
  const auto levels = static_cast<std::size_t>(run.ticks.back().num_levels);
  if (levels == 0) return "";
  Frame frame{.corner = {kNames, kHead},
              .width = plot::kFigureWidth - kNames - kMaxima,
              .height = kRowHeight * static_cast<double>(levels),
              .x = time_range(run),
              .y = {0.0, 1.0}};
  Svg svg(plot::kFigureWidth, kHead + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "time [s]");
  svg.text({frame.corner.x + frame.width + 8.0, kHead - 8.0}, "largest", "legend");
  Frame row = frame;
  row.height = kRowHeight;
  for (std::size_t level = 0; level < levels; ++level, row.corner.y += kRowHeight)
    draw_level(svg, row, run, level);
  plot::outline(svg, frame);
  return svg.image("Residual of each level of the hierarchy over time, on its own scale");
}

}  // namespace surefoot::report
