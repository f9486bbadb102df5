#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <map>
#include <utility>

// Rows of bars over time, each with a name.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Svg;

constexpr double kRowHeight = 18.0, kHead = 34.0, kNames = 250.0;

using Times = std::vector<std::pair<double, double>>;  // from, to

struct Strip {
  std::string name;
  Times plain, strong;  // in two colours
};

// A bar is seen however short it is.
std::string bars(const Frame& frame, double y, const Times& times) {
  std::string path;
  for (const auto& [from, to] : times) {
    const double x = frame.px_x(from);
    path += plot::path_through({{x, y}, {std::max(frame.px_x(to), x + 1.0), y}});
  }
  return path;
}

std::string draw(const RunData& run, const std::vector<Strip>& strips,
                 const std::vector<plot::LegendEntry>& legend, const char* description) {
  if (strips.empty()) return "";
  const double end = run.ticks.back().time + run.header.control_period;
  const Frame frame{.corner = {kNames, legend.empty() ? 6.0 : kHead},
                    .width = plot::kFigureWidth - kNames - plot::kRightMargin,
                    .height = kRowHeight * static_cast<double>(strips.size()),
                    .x = {run.ticks.front().time, end},
                    .y = {0.0, 1.0}};
  Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "time [s]");
  double y = frame.corner.y + kRowHeight / 2.0;
  for (const Strip& strip : strips) {
    svg.text({kNames - 8.0, y + 4.0}, strip.name, "tick", plot::Anchor::end);
    svg.path(bars(frame, y, strip.plain), "bar b0");
    svg.path(bars(frame, y, strip.strong), "bar b1");
    y += kRowHeight;
  }
  plot::outline(svg, frame);
  plot::draw_legend(svg, frame.corner.x + frame.width, 20.0, legend);
  return svg.image(description);
}

}  // namespace

std::string active_rows_figure(const RunData& run) {
  constexpr std::size_t kMostRows = 24;
  using Key = std::pair<std::int16_t, std::int32_t>;  // level and id
  std::map<Key, double> totals;                       // time active [s]
  for (const ActiveTime& time : run.active) totals[{time.level, time.id}] += time.to - time.from;
  std::vector<std::pair<Key, double>> rows(totals.begin(), totals.end());
  std::sort(rows.begin(), rows.end(),
            [](const auto& a, const auto& b) { return a.second > b.second; });
  rows.resize(std::min(rows.size(), kMostRows));
  std::sort(rows.begin(), rows.end());
  std::vector<Strip> strips;
  for (const auto& [key, total] : rows) {
    Strip strip;
    strip.name = std::to_string(key.first + 1) + "  " + run.row_names.at(key);
    for (const ActiveTime& time : run.active) {
      if (Key{time.level, time.id} != key) continue;
      (time.beyond ? strip.strong : strip.plain).emplace_back(time.from, time.to);
    }
    strips.push_back(std::move(strip));
  }
  return draw(run, strips, {{"held at its bound", "bar b0"}, {"beyond it", "bar b1"}},
              "Inequality rows that were active, over time");
}

std::string event_figure(const RunData& run) {
  std::map<int, Strip> strips;
  for (const TickSample& tick : run.ticks) {
    const int event = tick.plan.event;
    if (event == 0) continue;
    Strip& strip = strips[event];
    const auto& names = run.header.event_names;
    const bool known = event > 0 && static_cast<std::size_t>(event) < names.size();
    strip.name = known ? names[static_cast<std::size_t>(event)] : "event " + std::to_string(event);
    strip.plain.emplace_back(tick.time, tick.time + run.header.control_period);
  }
  std::vector<Strip> rows;
  for (auto& [event, strip] : strips) rows.push_back(std::move(strip));
  return draw(run, rows, {}, "What the planner did, over time");
}

}  // namespace surefoot::report
