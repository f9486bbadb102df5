#include "surefoot/view/ground.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::report {
namespace {

constexpr double kSteepest = 1e-6;  // of a normal's z: a face that stands upright has no top

GroundPoint on_plane(const Vec3& point, const Vec3& normal, const Vec2& p) {
  if (normal.z() < kSteepest) return {};
  const Vec2 slope = -normal.head<2>() / normal.z();
  return {.face = 0, .z = point.z() + slope.dot(p - point.head<2>()), .slope = slope};
}

// The face of the box that a ray from above enters through.
GroundPoint on_box(const LogTerrain& box, const Vec2& p) {
  const Mat3 R = box.q_WT.toRotationMatrix();
  GroundPoint entry;
  double exit = std::numeric_limits<double>::infinity();  // lowest top of the slabs, downwards
  double lowest = -exit;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 normal = side * R.col(axis);
      const Vec3 point = box.position + 0.5 * box.size[axis] * normal;
      const double rest = normal.head<2>().dot(p - point.head<2>()) - normal.z() * point.z();
      if (std::abs(normal.z()) < kSteepest) {
        if (rest > 0.0) return {};
      } else if (normal.z() > 0.0 && -rest / normal.z() < exit) {
        entry = on_plane(point, normal, p);
        entry.face = 2 * axis + (side > 0.0 ? 1 : 0);
        exit = entry.z;
      } else if (normal.z() < 0.0) {
        lowest = std::max(lowest, -rest / normal.z());
      }
    }
  }
  return lowest < exit ? entry : GroundPoint{};
}

// Between the points of the grid, bilinear.
GroundPoint on_heights(const LogTerrain& grid, const Vec2& p) {
  if (grid.columns < 2 || grid.rows < 2) return {};
  const Vec2 steps(grid.columns - 1, grid.rows - 1), size = grid.size.head<2>();
  const Vec2 cell = size.cwiseQuotient(steps);
  const Vec2 place = (p - grid.position.head<2>() + 0.5 * size).cwiseQuotient(cell);
  if (place.minCoeff() < 0.0 || place.x() > steps.x() || place.y() > steps.y()) return {};
  const int i = std::min(static_cast<int>(place.x()), grid.columns - 2);
  const int j = std::min(static_cast<int>(place.y()), grid.rows - 2);
  const auto height = [&](int column, int row) {
    return grid.heights.at(static_cast<std::size_t>(row * grid.columns + column));
  };
  const double u = place.x() - i, v = place.y() - j;
  const double low = (1.0 - u) * height(i, j) + u * height(i + 1, j);
  const double high = (1.0 - u) * height(i, j + 1) + u * height(i + 1, j + 1);
  return {.face = 0,
          .z = grid.position.z() + (1.0 - v) * low + v * high,
          .slope = {(height(i + 1, j) - height(i, j)) / cell.x(), (high - low) / cell.y()}};
}

GroundPoint on(const LogTerrain& piece, const Vec2& p) {
  if (piece.shape == "plane") return on_plane(piece.position, piece.q_WT * Vec3::UnitZ(), p);
  if (piece.shape == "box") return on_box(piece, p);
  return on_heights(piece, p);
}

}  // namespace

GroundPoint Ground::at(const Vec2& p) const {
  constexpr int kFaces = 6;
  GroundPoint highest;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    GroundPoint here = on(pieces_[i], p);
    if (here.face < 0 || here.z <= highest.z) continue;
    here.face += kFaces * static_cast<int>(i);
    highest = here;
  }
  return highest;
}

}  // namespace surefoot::report
