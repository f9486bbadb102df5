#include "surefoot/view/side_view.hpp"

#include "surefoot/view/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

namespace surefoot::report {
namespace {

using plot::Frame;

double sole_offset(const RunData& run) {
  return std::isfinite(run.header.robot.foot_radius) ? run.header.robot.foot_radius : 0.0;
}

// Ground along the walk under the feet of one side.
struct Profile {
  std::vector<double> x, z;
};

// Between the footprints of the side, from one to the next along x.
double lateral(const std::vector<Vec2>& track, double x) {
  const auto next = std::ranges::upper_bound(track, x, {}, [](const Vec2& p) { return p.x(); });
  if (next == track.begin()) return track.front().y();
  if (next == track.end()) return track.back().y();
  const Vec2 &a = *(next - 1), &b = *next;
  return a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
}

Profile profile(const RunData& run, const plot::Range& range, bool left) {
  constexpr double kStep = 0.002;  // [m]
  std::vector<Vec2> track;
  for (const Footprint& print : footprints(run)) {
    if (is_left(kLegs[print.leg]) == left) track.emplace_back(print.p.head<2>());
  }
  std::ranges::sort(track, {}, [](const Vec2& p) { return p.x(); });
  const Ground ground(run.header.terrain);
  Profile result;
  if (track.empty() || !ground.known()) return result;
  for (double x = range.low; x <= range.high + kStep; x += kStep) {
    result.x.push_back(x);
    result.z.push_back(ground.at({x, lateral(track, x)}).z);
  }
  return result;
}

std::string line_of(const Frame& frame, const Profile& profile) {
  return plot::path_through(plot::thinned_curve(frame, profile.x, profile.z));
}

// Closed far below the frame; ground that ends somewhere is left a line.
void fill_below(plot::Svg& svg, const Frame& frame, const Profile& profile) {
  const std::string line = line_of(frame, profile);
  const bool whole = std::ranges::none_of(profile.z, [](double z) { return std::isnan(z); });
  if (line.empty() || !whole) return;
  const double deep = frame.y.low - frame.y.span();
  const std::string floor =
      plot::path_through({frame.at(frame.x.high, deep), frame.at(frame.x.low, deep)});
  svg.path(line + " L" + floor.substr(1) + "z", "ground");
}

void draw_path(plot::Svg& svg, const Frame& frame, const RunData& run, const std::string& style,
               const std::function<Vec3(const TickSample&)>& position) {
  std::vector<double> x, z;
  for (const TickSample& tick : run.ticks) {
    const Vec3 p = position(tick);
    x.push_back(p.x());
    z.push_back(p.z());
  }
  svg.path(plot::path_through(plot::thinned_curve(frame, x, z)), style);
}

}  // namespace

Frame side_frame(const RunData& run, const Frame& above, double top) {
  constexpr double kAround = 0.05;  // [m]
  const double sole = sole_offset(run);
  const Ground ground(run.header.terrain);
  plot::Range z;
  for (const TickSample& tick : run.ticks) {
    z.add(base(tick).z());
    z.add(centre_of_mass(tick).z());
    for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
      const Vec3 p = foot_centre(tick, leg);
      z.add(p.z() - sole);
      const double below = ground.at(p.head<2>()).z;
      if (std::isfinite(below)) z.add(below);
    }
  }
  z = {z.low - kAround, z.high + kAround};
  return {.corner = {above.corner.x, top},
          .width = above.width,
          .height = z.span() / above.x.span() * above.width,
          .x = above.x,
          .y = z};
}

void draw_side(plot::Svg& svg, const Frame& frame, const RunData& run,
               const std::vector<Footprint>& prints) {
  const Vec3 sole(0.0, 0.0, sole_offset(run));
  plot::draw_x_axis(svg, frame, "x [m]");
  plot::draw_y_axis(svg, frame, "z [m]");
  svg.begin_clip(frame.corner, frame.width, frame.height);
  const std::array profiles{profile(run, frame.x, true), profile(run, frame.x, false)};
  for (const Profile& side : profiles) fill_below(svg, frame, side);
  for (const Profile& side : profiles) svg.path(line_of(frame, side), "ground-line");
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    draw_path(svg, frame, run, "line fine c" + std::to_string(leg),
              [&](const TickSample& tick) -> Vec3 { return foot_centre(tick, leg) - sole; });
  }
  for (const Footprint& print : prints) {
    const bool front = is_front(kLegs[print.leg]);
    svg.circle(frame.at(print.p.x(), print.p.z() - sole.z()), front ? 5.0 : 3.4,
               "dot f" + std::to_string(print.leg));
  }
  draw_path(svg, frame, run, "line ink", centre_of_mass);
  draw_path(svg, frame, run, "line c5", base);
  svg.end_clip();
  plot::outline(svg, frame);
}

}  // namespace surefoot::report
