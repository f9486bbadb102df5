#include "surefoot/view/ground_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

namespace surefoot::report {
namespace {

using plot::Point;

constexpr double kCell = 6.0;     // of the raster [px]
constexpr double kJump = 0.01;    // an edge [m]
constexpr double kCrease = 0.02;  // change of slope
constexpr double kLevel = 1e-3;   // slope of ground that is called level
constexpr int kTones = 5, kHalvings = 8;

// The ground at the corners of a raster over the frame.
struct Raster {
  Raster(const plot::Frame& shown, const Ground& all) : frame(shown), ground(all) {
    columns = static_cast<int>(std::ceil(frame.width / kCell)) + 1;
    rows = static_cast<int>(std::ceil(frame.height / kCell)) + 1;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < columns; ++i) points.push_back(ground.at(place(pixel(i, j))));
    }
    for (const GroundPoint& point : points) heights.add(point.z);
  }

  [[nodiscard]] Point pixel(int i, int j) const {
    return {frame.corner.x + kCell * i, frame.corner.y + kCell * j};
  }
  [[nodiscard]] Vec2 place(const Point& px) const {
    return {frame.x.low + (px.x - frame.corner.x) / frame.width * frame.x.span(),
            frame.y.high - (px.y - frame.corner.y) / frame.height * frame.y.span()};
  }
  [[nodiscard]] const GroundPoint& point(int i, int j) const {
    return points[static_cast<std::size_t>(j * columns + i)];
  }

  const plot::Frame& frame;
  const Ground& ground;
  int columns = 0, rows = 0;
  std::vector<GroundPoint> points;
  plot::Range heights;
};

enum class Border { none, crease, edge };

struct Crossing {
  Point at;
  Border border = Border::none;
};

Border border_between(const GroundPoint& a, const GroundPoint& b) {
  if (std::isnan(a.z) != std::isnan(b.z) || std::abs(a.z - b.z) > kJump) return Border::edge;
  return (a.slope - b.slope).norm() > kCrease ? Border::crease : Border::none;
}

// Where the line from one corner to another leaves the first one's face.
Crossing crossing(const Raster& raster, Point from, Point to, const GroundPoint& start) {
  GroundPoint before = start, after = raster.ground.at(raster.place(to));
  for (int i = 0; i < kHalvings; ++i) {
    const Point middle{(from.x + to.x) / 2.0, (from.y + to.y) / 2.0};
    const GroundPoint here = raster.ground.at(raster.place(middle));
    const bool inside = here.face == start.face;
    (inside ? from : to) = middle;
    (inside ? before : after) = here;
  }
  return {to, border_between(before, after)};
}

// Round the corner (i, j) … (i + 1, j + 1) of a cell.
constexpr std::array<std::array<int, 2>, 5> kRound{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};

std::vector<Crossing> crossings(const Raster& raster, int i, int j) {
  std::vector<Crossing> result;
  for (std::size_t k = 0; k < 4; ++k) {
    const int i0 = i + kRound[k][0], j0 = j + kRound[k][1];
    const int i1 = i + kRound[k + 1][0], j1 = j + kRound[k + 1][1];
    const GroundPoint& from = raster.point(i0, j0);
    if (from.face == raster.point(i1, j1).face) continue;
    result.push_back(crossing(raster, raster.pixel(i0, j0), raster.pixel(i1, j1), from));
  }
  return result;
}

struct Lines {
  std::string edges, creases;
};

// Where more than two borders cross a cell they meet in its middle.
void add_borders(const Raster& raster, int i, int j, Lines& lines) {
  const std::vector<Crossing> found = crossings(raster, i, j);
  if (found.empty()) return;
  Point middle{0.0, 0.0};
  Border border = Border::none;
  for (const Crossing& one : found) {
    middle.x += one.at.x / static_cast<double>(found.size());
    middle.y += one.at.y / static_cast<double>(found.size());
    border = std::max(border, one.border);
  }
  if (border == Border::none) return;
  std::string& path = border == Border::edge ? lines.edges : lines.creases;
  if (found.size() == 2) {
    path += plot::path_through({found[0].at, found[1].at});
    return;
  }
  for (const Crossing& one : found) path += plot::path_through({one.at, middle});
}

// Contour of one height in a cell that lies on one face.
void add_contour(const Raster& raster, int i, int j, double height, std::string& path) {
  std::vector<Point> ends;
  for (std::size_t k = 0; k < 4; ++k) {
    const int i0 = i + kRound[k][0], j0 = j + kRound[k][1];
    const int i1 = i + kRound[k + 1][0], j1 = j + kRound[k + 1][1];
    const GroundPoint &a = raster.point(i0, j0), &b = raster.point(i1, j1);
    if (a.face != b.face || std::isnan(a.z)) return;
    if ((a.z < height) == (b.z < height)) continue;
    const double share = (height - a.z) / (b.z - a.z);
    const Point p = raster.pixel(i0, j0), q = raster.pixel(i1, j1);
    ends.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
  }
  for (std::size_t k = 0; k + 1 < ends.size(); k += 2)
    path += plot::path_through({ends[k], ends[k + 1]});
}

bool slopes(const Raster& raster) {
  return std::ranges::any_of(raster.points,
                             [](const GroundPoint& p) { return p.slope.norm() > kLevel; });
}

// Each line is named where it meets the frame's upper edge.
void draw_contours(plot::Svg& svg, const Raster& raster) {
  constexpr double kLabelSpace = 46.0;
  double label_end = 0.0;
  for (const plot::Tick& level : plot::ticks(raster.heights, 8)) {
    std::string path;
    for (int j = 0; j + 1 < raster.rows; ++j) {
      for (int i = 0; i + 1 < raster.columns; ++i) add_contour(raster, i, j, level.value, path);
    }
    svg.path(path, "contour");
    for (int i = 0; i + 1 < raster.columns; ++i) {
      const GroundPoint &a = raster.point(i, 1), &b = raster.point(i + 1, 1);
      const double x = raster.pixel(i, 1).x;
      if (a.face != b.face || (a.z < level.value) == (b.z < level.value)) continue;
      if (x < label_end) continue;
      svg.text({x + 9.0, raster.frame.corner.y + 12.0}, level.label + " m", "note");
      label_end = x + kLabelSpace;
      break;
    }
  }
}

// Level ground is named at the frame's lower edge, where there is room for it.
void label_level_ground(plot::Svg& svg, const Raster& raster) {
  constexpr int kRoom = 14;  // cells
  const int row = raster.rows - 2;
  for (int begin = 0; begin + 1 < raster.columns;) {
    const GroundPoint& first = raster.point(begin, row);
    int end = begin + 1;
    while (end + 1 < raster.columns && raster.point(end, row).face == first.face) ++end;
    if (end - begin >= kRoom && first.face >= 0 && first.slope.norm() < kLevel) {
      const Point at = raster.pixel(begin, 0);
      svg.text({at.x + 7.0, raster.frame.corner.y + raster.frame.height - 6.0},
               "ground at " + plot::decimal(first.z, 3) + " m", "note");
    }
    begin = end;
  }
}

int tone(const Raster& raster, double z) {
  if (std::isnan(z)) return kTones - 1;
  const double share = (raster.heights.high - z) / raster.heights.span();
  return std::clamp(static_cast<int>(share * kTones), 0, kTones - 1);
}

// A run of one tone in a row of cells begins exactly where the ground changes.
std::vector<std::pair<double, int>> tones(const Raster& raster, int j) {
  const double y = raster.pixel(0, j).y + kCell / 2.0;
  const auto at = [&](double x) { return tone(raster, raster.ground.at(raster.place({x, y})).z); };
  std::vector<std::pair<double, int>> runs{{raster.frame.corner.x, at(raster.frame.corner.x)}};
  for (int i = 1; i < raster.columns; ++i) {
    double low = raster.pixel(i - 1, j).x, high = raster.pixel(i, j).x;
    const int before = runs.back().second, after = at(high);
    if (after == before) continue;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = (low + high) / 2.0;
      (at(middle) == before ? low : high) = middle;
    }
    runs.emplace_back(high, after);
  }
  return runs;
}

void draw_tones(plot::Svg& svg, const Raster& raster) {
  for (int begin = 0; begin + 1 < raster.rows;) {
    const auto runs = tones(raster, begin);
    int end = begin + 1;
    while (end + 1 < raster.rows && tones(raster, end) == runs) ++end;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      const double right =
          k + 1 < runs.size() ? runs[k + 1].first : raster.frame.corner.x + raster.frame.width;
      svg.rectangle({runs[k].first, raster.pixel(0, begin).y}, right - runs[k].first,
                    kCell * (end - begin), "g" + std::to_string(runs[k].second));
    }
    begin = end;
  }
}

}  // namespace

void draw_ground(plot::Svg& svg, const plot::Frame& frame, const Ground& ground) {
  if (!ground.known()) return;
  const Raster raster(frame, ground);
  if (raster.heights.empty()) return;
  if (raster.heights.span() > kJump) draw_tones(svg, raster);
  if (slopes(raster)) draw_contours(svg, raster);
  Lines lines;
  for (int j = 0; j + 1 < raster.rows; ++j) {
    for (int i = 0; i + 1 < raster.columns; ++i) add_borders(raster, i, j, lines);
  }
  svg.path(lines.creases, "crease");
  svg.path(lines.edges, "edge");
  if (raster.heights.span() > kJump) label_level_ground(svg, raster);
}

}  // namespace surefoot::report
