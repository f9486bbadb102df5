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
  const double x = frame.px_x(std::log10(value));
  svg.line({x, frame.corner.y}, {x, frame.corner.y + frame.height}, "bound");
  const bool at_right_end = x > frame.corner.x + 0.8 * frame.width;
  svg.text({x + (at_right_end ? -5.0 : 5.0), frame.corner.y + 15.0 + 15.0 * row},
           name + " " + plot::decimal(value, value < 10.0 ? 1 : 0) + " µs", "note",
           at_right_end ? plot::Anchor::end : plot::Anchor::start);
}

// Ticks at 1, 2 and 5 times the powers of ten; `frame.x` is in decades.
void draw_logarithmic_axis(plot::Svg& svg, const plot::Frame& frame, const std::string& label) {
  const double bottom = frame.corner.y + frame.height;
  for (int power = static_cast<int>(std::floor(frame.x.low)); power <= frame.x.high; ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double decades = power + std::log10(factor);
      if (decades < frame.x.low || decades > frame.x.high) continue;
      const double x = frame.px_x(decades);
      svg.line({x, frame.corner.y}, {x, bottom}, "grid");
      svg.text({x, bottom + 15.0}, plot::decimal(std::pow(10.0, decades), std::max(0, -power)),
               "tick", plot::Anchor::middle);
    }
  }
  svg.text({frame.corner.x + frame.width / 2.0, bottom + 32.0}, label, "label",
           plot::Anchor::middle);
}

}  // namespace

std::string timing_figure(const RunData& run) {
  std::vector<double> totals;
  for (const TickTiming& timing : run.timings) {
    if (timing.total > 0.0) totals.push_back(timing.total);
  }
  if (totals.empty()) return "";
  std::sort(totals.begin(), totals.end());
  constexpr int kBins = 90;
  const double period = 1e6 * run.header.control_period;
  const plot::Range x{std::log10(std::min(totals.front(), period)) - 0.1,
                      std::log10(std::max(totals.back(), period)) + 0.1};
  std::vector<double> shares(kBins, 0.0);
  for (const double total : totals) {
    const auto bin = static_cast<std::size_t>((std::log10(total) - x.low) / x.span() * kBins);
    shares[std::min<std::size_t>(bin, kBins - 1)] += 100.0 / static_cast<double>(totals.size());
  }
  const double highest = *std::max_element(shares.begin(), shares.end());
  const plot::Frame frame{.corner = {plot::kLeftMargin, 24.0},
                          .width = plot::kFigureWidth - plot::kLeftMargin - plot::kRightMargin,
                          .height = 170.0,
                          .x = x,
                          .y = {0.0, 1.08 * highest}};
  plot::Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  draw_logarithmic_axis(svg, frame, "time per tick [µs]");
  plot::draw_y_axis(svg, frame, "share of ticks [%]");
  for (int i = 0; i < kBins; ++i) {
    const double share = shares[static_cast<std::size_t>(i)];
    if (share == 0.0) continue;
    // A single tick is still seen.
    const double height = std::max(frame.corner.y + frame.height - frame.px_y(share), 1.0);
    svg.rectangle(
        {frame.px_x(x.low + i * x.span() / kBins), frame.corner.y + frame.height - height},
        frame.width / kBins - 1.0, height, "column");
  }
  mark(svg, frame, quantile(totals, 0.5), "median", 0);
  mark(svg, frame, quantile(totals, 0.99), "99 %", 1);
  mark(svg, frame, totals.back(), "slowest", 2);
  mark(svg, frame, period, "period", 3);
  plot::outline(svg, frame);
  return svg.image("Histogram of the time per tick");
}

}  // namespace surefoot::report
