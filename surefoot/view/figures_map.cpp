#include "surefoot/view/ground_lines.hpp"
#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/side_view.hpp"
#include "surefoot/view/time_figure.hpp"

#include <algorithm>
#include <cmath>

// The walk in space, from above and from the side.
namespace surefoot::report {
namespace {

using plot::Frame;
using plot::Point;
using plot::Svg;

constexpr double kHead = 44.0, kBetween = 66.0, kFoot = 42.0;  // around the two views [px]

// The feet that carry the robot without a change, for at least a tenth of a second.
struct Support {
  std::array<bool, kNumLegs> legs{};
  double from = 0.0;
  std::vector<Vec2> feet;
};

Vec2 foot(const TickSample& tick, std::size_t leg) { return foot_centre(tick, leg).head<2>(); }

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
  return {.corner = {plot::kLeftMargin, kHead},
          .width = width,
          .height = y.span() / metres_per_px,
          .x = {x.low - spare, x.high + spare},
          .y = y};
}

// Around the footprints, and as far as any foot went.
Frame frame_above(const RunData& run, const std::vector<Footprint>& prints) {
  constexpr double kAround = 0.08;  // [m]
  plot::Range x, y;
  for (const Footprint& print : prints) {
    x.add(print.p.x());
    y.add(print.p.y());
  }
  for (const TickSample& tick : run.ticks) {
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) x.add(foot_centre(tick, leg).x());
  }
  return fit({x.low - kAround, x.high + kAround}, {y.low - kAround, y.high + kAround});
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

// Front feet below and larger: a hind foot that steps into their print stays visible in it.
void draw_prints(Svg& svg, const Frame& frame, const std::vector<Footprint>& prints) {
  for (const bool front : {true, false}) {
    for (const Footprint& print : prints) {
      if (is_front(kLegs[print.leg]) != front) continue;
      svg.circle(frame.at(print.p.x(), print.p.y()), front ? 6.5 : 3.8,
                 "dot f" + std::to_string(print.leg),
                 std::string(kLegNames[print.leg]) + " at " + plot::decimal(print.time, 2) + " s");
    }
  }
}

void draw_above(Svg& svg, const Frame& frame, const RunData& run,
                const std::vector<Footprint>& prints) {
  svg.begin_clip(frame.corner, frame.width, frame.height);
  draw_ground(svg, frame, Ground(run.header.terrain));
  svg.end_clip();
  plot::draw_x_axis(svg, frame, "x [m]");
  plot::draw_y_axis(svg, frame, "y [m]");
  svg.begin_clip(frame.corner, frame.width, frame.height);
  for (const Support& support : supports(run)) {
    std::vector<Point> polygon;
    for (const Vec2& p : support.feet) polygon.push_back(frame.at(p.x(), p.y()));
    svg.polygon(polygon, "support");
  }
  draw_path(svg, frame, run, "line ink",
            [](const TickSample& tick) -> Vec2 { return centre_of_mass(tick).head<2>(); });
  draw_path(svg, frame, run, "line c1 dashed",
            [](const TickSample& tick) { return tick.desired_com; });
  draw_prints(svg, frame, prints);
  svg.end_clip();
  plot::outline(svg, frame);
}

std::vector<plot::LegendEntry> legend(const RunData& run) {
  const std::string source = run.has_truth ? "true" : "estimated";
  std::vector<plot::LegendEntry> entries{
      {"base (side)", "line c5"}, {source + " COM", "line ink"}, {"desired COM", "line c1 dashed"}};
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    entries.push_back({std::string(kLegNames[leg]), "line thick c" + std::to_string(leg)});
  }
  return entries;
}

}  // namespace

std::vector<Footprint> footprints(const RunData& run) {
  std::vector<Footprint> result;
  PerLeg<bool> down{};
  for (const TickSample& tick : run.ticks) {
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      const bool contact = in_contact(tick.plan.feet[leg].phase);
      if (contact && !down[leg]) result.push_back({leg, tick.time, foot_centre(tick, leg)});
      down[leg] = contact;
    }
  }
  return result;
}

std::string map_figure(const RunData& run) {
  const std::vector<Footprint> prints = footprints(run);
  if (prints.empty()) return "";
  const Frame above = frame_above(run, prints);
  const Frame side = side_frame(run, above, above.corner.y + above.height + kBetween);
  Svg svg(plot::kFigureWidth, side.corner.y + side.height + kFoot);
  draw_above(svg, above, run, prints);
  draw_side(svg, side, run, prints);
  for (const auto& [frame, name] :
       {std::pair{&above, "(a) from above"}, std::pair{&side, "(b) from the side"}}) {
    svg.text({frame->corner.x, frame->corner.y - 7.0}, name, "panel-title");
  }
  plot::draw_legend(svg, above.corner.x + above.width, 14.0, legend(run));
  return svg.image(
      "Ground, footprints, path of the centre of mass and support triangles from above; below, "
      "ground, paths of the feet, base and centre of mass from the side");
}

}  // namespace surefoot::report
