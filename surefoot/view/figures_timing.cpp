#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::report {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

void mark(plot::Svg& svg, const plot::Frame& frame, double value, const std::string& name,
          int row) {
  if (value > frame.x.high) return;
  svg.line({frame.px_x(value), frame.corner.y}, {frame.px_x(value), frame.corner.y + frame.height},
           "bound");
  svg.text({frame.px_x(value) + 5.0, frame.corner.y + 15.0 + 15.0 * row},
           name + " " + plot::decimal(value, value < 10.0 ? 1 : 0) + " µs", "note");
}

}  // namespace

std::string timing_figure(const RunData& run) {
  if (run.timings.empty()) return "";
  std::vector<double> totals;
  for (const TickTiming& timing : run.timings) totals.push_back(timing.total);
  std::sort(totals.begin(), totals.end());
  constexpr int kBins = 80;
  // The few slowest ticks are named, not drawn: they would squeeze all others.
  const double high = 1.15 * quantile(totals, 0.998), width = high / kBins;
  std::vector<double> shares(kBins, 0.0);
  double drawn = 0.0;
  for (const double total : totals) {
    if (total >= high) continue;
    shares[static_cast<std::size_t>(total / width)] += 100.0 / static_cast<double>(totals.size());
    ++drawn;
  }
  plot::Range y;
  y.add(0.0);
  y.add(shares);
  const plot::Frame frame{.corner = {plot::kLeftMargin, 24.0},
                          .width = plot::kFigureWidth - plot::kLeftMargin - plot::kRightMargin,
                          .height = 170.0,
                          .x = {0.0, high},
                          .y = {0.0, 1.08 * y.high}};
  plot::Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "time per tick [µs]");
  plot::draw_y_axis(svg, frame, "share of ticks [%]");
  for (int i = 0; i < kBins; ++i) {
    const double share = shares[static_cast<std::size_t>(i)];
    if (share == 0.0) continue;
    svg.rectangle(frame.at(i * width, share), frame.width / kBins - 1.0,
                  frame.corner.y + frame.height - frame.px_y(share), "column");
  }
  mark(svg, frame, quantile(totals, 0.5), "median", 0);
  mark(svg, frame, quantile(totals, 0.99), "99 %", 1);
  plot::outline(svg, frame);
  const double beyond = static_cast<double>(totals.size()) - drawn;
  svg.text({frame.corner.x + frame.width, 16.0},
           "slowest tick " + plot::decimal(totals.back(), 0) + " µs; " + plot::decimal(beyond, 0) +
               " ticks lie beyond the axis",
           "note", plot::Anchor::end);
  return svg.image("Histogram of the time per tick");
}

}  // namespace surefoot::report
