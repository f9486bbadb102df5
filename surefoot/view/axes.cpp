#include "surefoot/view/axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace surefoot::plot {
namespace {

constexpr double kTolerance = 0.2;  // [px]

double distance_to_line(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double length = std::hypot(dx, dy);
  if (length == 0.0) return std::hypot(p.x - a.x, p.y - a.y);
  return std::abs(dx * (p.y - a.y) - dy * (p.x - a.x)) / length;
}

// Ramer–Douglas–Peucker on an unbroken curve.
void simplify(const std::vector<Point>& points, std::vector<Point>& out) {
  if (points.size() < 3) {
    out.insert(out.end(), points.begin(), points.end());
    return;
  }
  std::vector<bool> keep(points.size(), false);
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    std::size_t farthest = first;
    double distance = kTolerance;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance_to_line(points[i], points[first], points[last]);
      if (d > distance) {
        distance = d;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    keep[farthest] = true;
    open.emplace_back(first, farthest);
    open.emplace_back(farthest, last);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i]) out.push_back(points[i]);
  }
}

// First, lowest, highest and last point of each pixel column.
std::vector<Point> envelope(const std::vector<Point>& points) {
  std::vector<Point> out;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin;
    const double column = std::floor(points[begin].x);
    while (end < points.size() && std::floor(points[end].x) == column) ++end;
    const auto by_y = [&](std::size_t a, std::size_t b) { return points[a].y < points[b].y; };
    std::array<std::size_t, 4> chosen{begin, begin, begin, end - 1};
    for (std::size_t i = begin; i < end; ++i) {
      if (by_y(i, chosen[1])) chosen[1] = i;
      if (by_y(chosen[2], i)) chosen[2] = i;
    }
    std::sort(chosen.begin(), chosen.end());
    const auto last = std::unique(chosen.begin(), chosen.end());
    for (auto i = chosen.begin(); i != last; ++i) out.push_back(points[*i]);
    begin = end;
  }
  return out;
}

}  // namespace

void Range::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

void Range::add(const std::vector<double>& values) {
  for (const double value : values) add(value);
}

Range Range::padded(double share) const {
  if (empty()) return {0.0, 1.0};
  const double least = std::max({1e-9, 1e-6 * std::abs(low), 1e-6 * std::abs(high)});
  const double margin = std::max(share * span(), span() < least ? least : 0.0);
  return {low - margin, high + margin};
}

std::vector<Tick> ticks(const Range& range, int count) {
  // The round step whose number of ticks is nearest to the wanted one.
  const double rough = range.span() / std::max(count, 1);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (std::abs(std::log(factor * power / rough)) < std::abs(std::log(step / rough)))
      step = factor * power;
  }
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::vector<Tick> result;
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high + 1e-9 * step; ++i) {
    result.push_back({i * step, decimal(i * step, decimals)});
  }
  return result;
}

void draw_x_axis(Svg& svg, const Frame& frame, std::string_view label, bool with_numbers) {
  const double bottom = frame.corner.y + frame.height;
  for (const Tick& tick : ticks(frame.x, static_cast<int>(frame.width / 75.0))) {
    const double x = frame.px_x(tick.value);
    svg.line({x, frame.corner.y}, {x, bottom}, "grid");
    if (with_numbers) svg.text({x, bottom + 15.0}, tick.label, "tick", Anchor::middle);
  }
  if (!label.empty())
    svg.text({frame.corner.x + frame.width / 2.0, bottom + 32.0}, label, "label", Anchor::middle);
}

void draw_y_axis(Svg& svg, const Frame& frame, std::string_view label) {
  for (const Tick& tick : ticks(frame.y, std::max(3, static_cast<int>(frame.height / 30.0)))) {
    const double y = frame.px_y(tick.value);
    svg.line({frame.corner.x, y}, {frame.corner.x + frame.width, y}, "grid");
    svg.text({frame.corner.x - 7.0, y + 4.0}, tick.label, "tick", Anchor::end);
  }
  if (!label.empty())
    svg.vertical_text({16.0, frame.corner.y + frame.height / 2.0}, label, "label");
}

void outline(Svg& svg, const Frame& frame) {
  svg.rectangle(frame.corner, frame.width, frame.height, "frame");
}

std::vector<Point> thinned_curve(const Frame& frame, const std::vector<double>& x,
                                 const std::vector<double>& y) {
  std::vector<Point> out, piece;
  const auto end_piece = [&] {
    if (piece.empty()) return;
    if (!out.empty()) out.push_back({std::nan(""), std::nan("")});
    simplify(envelope(piece), out);
    piece.clear();
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isfinite(y[i])) {
      piece.push_back(frame.at(x[i], y[i]));
    } else {
      end_piece();
    }
  }
  end_piece();
  return out;
}

}  // namespace surefoot::plot
