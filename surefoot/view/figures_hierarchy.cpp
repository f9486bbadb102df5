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

constexpr double kRowHeight = 27.0, kHead = 24.0;
constexpr double kLeastNames = 150.0, kLeastMaxima = 70.0;  // beside the curves [px]

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

// A level's name and largest residual, beside its curve.
struct Row {
  std::string name, size;
  std::vector<double> values;
  bool restless = false, is_zero = true;
};

Row row_of(const RunData& run, std::size_t level) {
  const auto number = static_cast<std::ptrdiff_t>(level);
  const std::string task = run.header.level_name(number), unit = run.header.level_unit(number);
  Row row{.name = std::to_string(level + 1) + "  " + task,
          .size = "0",
          .values = residuals(run, level),
          .restless = never_zero(task)};
  std::ranges::replace(row.name, '_', ' ');
  const double largest = *std::ranges::max_element(row.values);
  row.is_zero = !(largest > kResidualRounding);
  if (!row.is_zero) row.size = plot::two_digits(largest) + (unit.empty() ? "" : " " + unit);
  if (row.restless) row.size += "  *";
  return row;
}

// So that none of these texts is cut off.
double widest(const std::vector<Row>& rows, std::string Row::* text, double least) {
  for (const Row& row : rows) least = std::max(least, plot::text_width(row.*text) + 14.0);
  return least;
}

void draw_level(Svg& svg, const Frame& frame, const RunData& run, const Row& row) {
  draw_curve(svg, frame, run, row.values, row.restless ? "area restless" : "area");
  const double bottom = frame.corner.y + frame.height, right = frame.corner.x + frame.width;
  svg.line({frame.corner.x, bottom}, {right, bottom}, "grid");
  svg.text({frame.corner.x - 8.0, bottom - 7.0}, row.name, "tick", plot::Anchor::end);
  svg.text({right + 8.0, bottom - 7.0}, row.size, row.is_zero ? "tick" : "label");
}

}  // namespace

std::string residual_figure(const RunData& run) {
  const auto levels = static_cast<std::size_t>(run.ticks.back().num_levels);
  if (levels == 0) return "";
  std::vector<Row> rows;
  for (std::size_t level = 0; level < levels; ++level) rows.push_back(row_of(run, level));
  const double names = widest(rows, &Row::name, kLeastNames);
  const Frame frame{.corner = {names, kHead},
                    .width = plot::kFigureWidth - names - widest(rows, &Row::size, kLeastMaxima),
                    .height = kRowHeight * static_cast<double>(levels),
                    .x = time_range(run),
                    .y = {0.0, 1.0}};
  Svg svg(plot::kFigureWidth, kHead + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "time [s]");
  svg.text({frame.corner.x + frame.width + 8.0, kHead - 8.0}, "largest", "legend");
  Frame place = frame;
  place.height = kRowHeight;
  for (const Row& row : rows) {
    draw_level(svg, place, run, row);
    place.corner.y += kRowHeight;
  }
  plot::outline(svg, frame);
  plot::draw_calibration(svg, frame, calibration_times(run), true);
  return svg.image("Residual of each level of the hierarchy over time, on its own scale");
}

}  // namespace surefoot::report
