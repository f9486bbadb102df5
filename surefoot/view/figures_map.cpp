#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <cmath>

// The view from above.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Point;
using plot::Svg;

struct Footprint {
  std::size_t leg;
  double time;
  Vec2 p;
};

// The feet that carry the robot without a change, for at least a tenth of a second.
struct Support {
  std::array<bool, kNumLegs> legs{};
  double from = 0.0;
  std::vector<Vec2> feet;
};

Vec2 foot(const TickSample& tick, std::size_t leg) {
  return (std::isnan(tick.truth.time) ? tick.model.p_WF[leg] : tick.truth.p_WF[leg]).head<2>();
}

std::vector<Footprint> footprints(const RunData& run) {
  std::vector<Footprint> result;
  PerLeg<bool> down{};
  for (const TickSample& tick : run.ticks) {
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      const bool contact = in_contact(tick.plan.feet[leg].phase);
      if (contact && !down[leg]) result.push_back({leg, tick.time, foot(tick, leg)});
      down[leg] = contact;
    }
  }
  return result;
}

// Around the polygon of the legs LF, RF, RH, LH.
std::vector<Vec2> corners(const TickSample& tick, const std::array<bool, kNumLegs>& legs) {
  std::vector<Vec2> result;
  for (const Leg leg : {Leg::LF, Leg::RF, Leg::RH, Leg::LH}) {
    if (legs[index(leg)]) result.push_back(foot(tick, index(leg)));
  }
  return result;
}

std::vector<Support> supports(const RunData& run) {
  constexpr double kShortest = 0.1;  // [s]
  std::vector<Support> result;
  Support open;
  const auto end = [&](double time) {
    if (open.feet.size() == 3 && time - open.from >= kShortest) result.push_back(open);
  };
  for (const TickSample& tick : run.ticks) {
    std::array<bool, kNumLegs> legs{};
    for (std::size_t leg = 0; leg < kNumLegs; ++leg)
      legs[leg] = in_contact(tick.plan.feet[leg].phase);
    if (legs == open.legs) continue;
    end(tick.time);
    open = {legs, tick.time, corners(tick, legs)};
  }
  end(run.ticks.back().time);
  return result;
}

// The same scale along both axes.
Frame fit(const plot::Range& x, const plot::Range& y) {
  constexpr double kMaxHeight = 520.0;
  const double width = plot::kFigureWidth - plot::kLeftMargin - plot::kRightMargin;
  const double metres_per_px = std::max(x.span() / width, y.span() / kMaxHeight);
  const double spare = (metres_per_px * width - x.span()) / 2.0;
  return {.corner = {plot::kLeftMargin, 26.0},
          .width = width,
          .height = y.span() / metres_per_px,
          .x = {x.low - spare, x.high + spare},
          .y = y};
}

void draw_path(Svg& svg, const Frame& frame, const RunData& run, const char* style,
               Vec2 (*position)(const TickSample&)) {
  std::vector<double> x, y;
  for (const TickSample& tick : run.ticks) {
    x.push_back(position(tick).x());
    y.push_back(position(tick).y());
  }
  svg.path(plot::path_through(plot::thinned_curve(frame, x, y)), style);
}

}  // namespace

std::string footprint_figure(const RunData& run) {
  const std::vector<Footprint> prints = footprints(run);
  plot::Range x, y;
  for (const Footprint& print : prints) {
    x.add(print.p.x());
    y.add(print.p.y());
  }
  if (x.empty()) return "";
  x = {x.low - 0.08, x.high + 0.08};
  y = {y.low - 0.08, y.high + 0.08};
  const Frame frame = fit(x, y);
  Svg svg(plot::kFigureWidth, frame.corner.y + frame.height + 42.0);
  plot::draw_x_axis(svg, frame, "x [m]");
  plot::draw_y_axis(svg, frame, "y [m]");
  svg.begin_clip(frame.corner, frame.width, frame.height);
  for (const Support& support : supports(run)) {
    std::vector<Point> polygon;
    for (const Vec2& p : support.feet) polygon.push_back(frame.at(p.x(), p.y()));
    svg.polygon(polygon, "support");
  }
  draw_path(svg, frame, run, "line c1 dashed",
            [](const TickSample& tick) { return tick.plan.com.p; });
  draw_path(svg, frame, run, "line ink", [](const TickSample& tick) -> Vec2 {
    return (std::isnan(tick.truth.time) ? tick.model.p_WCom : tick.truth.p_WCom).head<2>();
  });
  // Front feet below and larger: a hind foot that steps into their print stays visible in it.
  for (const bool front : {true, false}) {
    for (const Footprint& print : prints) {
      if (is_front(kLegs[print.leg]) != front) continue;
      svg.circle(frame.at(print.p.x(), print.p.y()), front ? 6.5 : 3.8,
                 "dot f" + std::to_string(print.leg),
                 std::string(kLegNames[print.leg]) + " at " + plot::decimal(print.time, 2) + " s");
    }
  }
  svg.end_clip();
  plot::outline(svg, frame);
  std::vector<plot::LegendEntry> legend{{run.has_truth ? "true COM" : "estimated COM", "line ink"},
                                        {"desired COM", "line c1 dashed"}};
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    legend.push_back({std::string(kLegNames[leg]), "line thick c" + std::to_string(leg)});
  }
  plot::draw_legend(svg, frame.corner.x + frame.width, 16.0, legend);
  return svg.image("Footprints, path of the centre of mass and support triangles from above");
}

}  // namespace surefoot::report
