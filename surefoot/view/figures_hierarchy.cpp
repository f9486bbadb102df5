#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

// How the levels of the hierarchy came out.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Svg;

constexpr double kRowHeight = 18.0, kNames = 190.0, kHead = 34.0;
constexpr int kClasses = 7;  // of colour: residuals from 1e-9 to 1e3 in steps of two decades …
constexpr double kLowest = -8.0, kDecades = 2.0;  // … all below 1e-8 in the first class

int colour_class(double residual) {
  if (!(residual > 0.0)) return 0;
  const double steps = (std::log10(residual) - kLowest) / kDecades;
  return std::clamp(static_cast<int>(std::floor(steps)) + 1, 0, kClasses - 1);
}

std::string superscript(int number) {
  constexpr std::array<const char*, 10> kDigits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  return (number < 0 ? "⁻" : "") +
         std::string(kDigits[static_cast<std::size_t>(std::abs(number) % 10)]);
}

std::string level_name(const RunData& run, std::size_t level) {
  const auto& names = run.header.level_names;
  std::string name = level < names.size() ? names[level] : "";
  std::replace(name.begin(), name.end(), '_', ' ');
  return std::to_string(level + 1) + "  " + name;
}

Frame rows_frame(const RunData& run, std::size_t rows) {
  return {
      .corner = {kNames, kHead},
      .width = plot::kFigureWidth - kNames - plot::kRightMargin,
      .height = kRowHeight * static_cast<double>(rows),
      .x = plot::Range{run.ticks.front().time, run.ticks.back().time + run.header.control_period},
      .y = {0.0, 1.0}};
}

// The largest residual of each pixel column, drawn as bars of equal colour class.
void draw_level(Svg& svg, const Frame& frame, const RunData& run, std::size_t level) {
  const auto columns = static_cast<std::size_t>(frame.width);
  std::vector<int> classes(columns, -1);
  for (const TickSample& tick : run.ticks) {
    const double position =
        (tick.time - frame.x.low) / frame.x.span() * static_cast<double>(columns);
    int& here = classes[std::min(static_cast<std::size_t>(position), columns - 1)];
    here = std::max(here, colour_class(tick.residuals[level]));
  }
  // Runs shorter than a column's tick leave holes: the last value goes on.
  for (std::size_t i = 1; i < columns; ++i)
    classes[i] = classes[i] < 0 ? classes[i - 1] : classes[i];
  const double y = frame.corner.y + kRowHeight * static_cast<double>(level);
  for (std::size_t begin = 0; begin < columns;) {
    std::size_t end = begin;
    while (end < columns && classes[end] == classes[begin]) ++end;
    svg.rectangle({frame.corner.x + static_cast<double>(begin), y + 1.0},
                  static_cast<double>(end - begin), kRowHeight - 2.0,
                  "heat h" + std::to_string(std::max(classes[begin], 0)));
    begin = end;
  }
}

void draw_key(Svg& svg, double right) {
  double x = right - 42.0 * kClasses;
  svg.text({x - 8.0, 15.0}, "residual", "legend", plot::Anchor::end);
  for (int i = 0; i < kClasses; ++i, x += 42.0) {
    svg.rectangle({x, 5.0}, 42.0, 11.0, "heat h" + std::to_string(i));
    const int power = static_cast<int>(kLowest + kDecades * i);
    if (i + 1 < kClasses)
      svg.text({x + 42.0, 28.0}, "10" + superscript(power), "tick", plot::Anchor::middle);
  }
}

}  // namespace

std::string residual_figure(const RunData& run) {
  const auto levels = static_cast<std::size_t>(run.ticks.back().num_levels);
  if (levels == 0) return "";
  const Frame frame = rows_frame(run, levels);
  Svg svg(plot::kFigureWidth, kHead + frame.height + 42.0);
  draw_key(svg, frame.corner.x + frame.width);
  for (std::size_t level = 0; level < levels; ++level) {
    draw_level(svg, frame, run, level);
    svg.text({kNames - 8.0, frame.corner.y + kRowHeight * (static_cast<double>(level) + 0.7)},
             level_name(run, level), "tick", plot::Anchor::end);
  }
  plot::draw_x_axis(svg, frame, "time [s]");
  plot::outline(svg, frame);
  return svg.image("Residual of each level of the hierarchy over time");
}

}  // namespace surefoot::report
