#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <optional>
#include <utility>

// Rows of bars over time, each with a name.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Svg;

constexpr double kRowHeight = 18.0, kHead = 34.0, kLeastNames = 150.0;
constexpr double kShortest = 0.01;  // what acted for less is a flicker [s]

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

double names_width(const std::vector<Strip>& strips) {
  double width = kLeastNames;
  for (const Strip& strip : strips) width = std::max(width, plot::text_width(strip.name) + 14.0);
  return width;
}

std::string draw(const RunData& run, const std::vector<Strip>& strips,
                 const std::vector<plot::LegendEntry>& legend, const char* description) {
  if (strips.empty()) return "";
  const double names = names_width(strips);
  const Frame frame{.corner = {names, legend.empty() ? 6.0 : kHead},
                    .width = plot::kFigureWidth - names - plot::kRightMargin,
                    .height = kRowHeight * static_cast<double>(strips.size()),
                    .x = time_range(run),
                    .y = {0.0, 1.0}};
  Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "time [s]");
  double y = frame.corner.y + kRowHeight / 2.0;
  for (const Strip& strip : strips) {
    svg.text({names - 8.0, y + 4.0}, strip.name, "tick", plot::Anchor::end);
    svg.path(bars(frame, y, strip.plain), "bar b0");
    svg.path(bars(frame, y, strip.strong), "bar b1");
    y += kRowHeight;
  }
  plot::outline(svg, frame);
  plot::draw_calibration(svg, frame, calibration_times(run), false);
  plot::draw_legend(svg, frame.corner.x + frame.width, 20.0, legend);
  return svg.image(description);
}

// A tick is added to the last stretch if that one has just ended.
void add(Times& times, double from, double to) {
  if (!times.empty() && from - times.back().second < 0.5 * (to - from)) {
    times.back().second = to;
  } else {
    times.emplace_back(from, to);
  }
}

std::optional<std::size_t> leg_of(const std::string& row) {
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    if (row.starts_with(kLegNames[leg])) return leg;
  }
  return std::nullopt;
}

bool is_normal_force(const std::string& row) { return row.ends_with(" normal force"); }
bool is_slip(const std::string& row) { return row.find(" slip ") != std::string::npos; }

// At lift-off and touchdown the force passes through zero, where all sides of the friction cone
// meet, and follows its ramp: that rows hold there says nothing of the run.
bool says_something(const RunData& run, const TickSample& tick, const ActiveRow& row,
                    const std::string& name) {
  constexpr double kLoaded = 0.1;  // of the weight, as for the friction margin
  const std::optional<std::size_t> leg = leg_of(name);
  if (!leg || std::abs(row.state) > 1 || !(is_slip(name) || is_normal_force(name))) return true;
  const FootPlan& foot = tick.plan.feet[*leg];
  if (is_normal_force(name))
    return row.state < 0 && foot.phase == LegPhase::stance && foot.force_max > 2.0 * foot.force_min;
  const double load = tick.plan.R_WC.col(2).dot(tick.model.force[*leg]);
  return !(load < kLoaded * run.header.robot.mass * kGravity);
}

std::string in_words(std::string level) {
  std::replace(level.begin(), level.end(), '_', ' ');
  if (level.ends_with("limits")) level.pop_back();
  return level;
}

// Rows of a leg in a level are one group, but its normal force another.
std::string group_of(const RunData& run, const ActiveRow& row, const std::string& name) {
  const std::string task = in_words(run.header.level_name(row.level));
  const std::string number = std::to_string(row.level + 1) + "  ";
  const std::optional<std::size_t> leg = leg_of(name);
  if (!leg) return number + task + ": " + name;
  const std::string leg_name(kLegNames[*leg]);
  if (is_normal_force(name)) return number + "least normal force " + leg_name;
  return number + task + " " + leg_name;
}

// A group of rows: by level, then by leg, then by name.
struct Group {
  int level = 0;
  std::size_t leg = kNumLegs;
  std::string name;
  auto operator<=>(const Group&) const = default;
};

std::map<Group, Strip> groups(const RunData& run) {
  std::map<Group, Strip> result;
  for (const TickSample& tick : run.ticks) {
    for (const ActiveRow& row : tick.active) {
      const std::string& name = run.row_names.at({row.level, row.id});
      if (!says_something(run, tick, row, name)) continue;
      const Group group{row.level, leg_of(name).value_or(kNumLegs), group_of(run, row, name)};
      Strip& strip = result[group];
      strip.name = group.name;
      add(std::abs(row.state) > 1 ? strip.strong : strip.plain, tick.time,
          tick.time + run.header.control_period);
    }
  }
  return result;
}

}  // namespace

std::string active_rows_figure(const RunData& run) {
  std::vector<Strip> strips;
  for (auto& [group, strip] : groups(run)) {
    std::erase_if(strip.plain,
                  [](const auto& time) { return time.second - time.first < kShortest; });
    if (!strip.plain.empty() || !strip.strong.empty()) strips.push_back(std::move(strip));
  }
  return draw(run, strips, {{"held at its bound", "bar b0"}, {"beyond it", "bar b1"}},
              "Inequalities that acted, by task and leg, over time");
}

std::string event_figure(const RunData& run) {
  std::map<int, Strip> strips;
  for (const TickSample& tick : run.ticks) {
    for (const GaitEvent& event : tick.plan.events) {
      const auto kind = static_cast<std::size_t>(event.kind);
      Strip& strip = strips[static_cast<int>(kind)];
      const auto& names = run.header.event_names;
      strip.name = kind < names.size() ? names[kind] : "event " + std::to_string(kind);
      strip.plain.emplace_back(tick.time, tick.time + run.header.control_period);
    }
  }
  std::vector<Strip> rows;
  for (auto& [event, strip] : strips) {
    strip.name += " (" + std::to_string(strip.plain.size()) + ")";
    rows.push_back(std::move(strip));
  }
  return draw(run, rows, {}, "What the planner did, over time");
}

}  // namespace surefoot::report
