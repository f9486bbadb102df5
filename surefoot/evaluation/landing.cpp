#include "surefoot/evaluation/landing.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kEdgeRadius = 0.02;             // around the contact point, at scale 1 [m]
constexpr double kMinEdgeHeight = 0.015;         // at scale 1 [m]
constexpr double kMaxTurn = 15.0 * kPi / 180.0;  // between contact normal and terrain normal

bool jumps(double height, double neighbour, double least) {
  return !(std::abs(height - neighbour) <= least);
}

/// Searches outwards from the point.
bool edge_in_reach(const TerrainHeight& terrain, const Vec3& point, double length) {
  constexpr int kDirections = 32, kSteps = 5;
  const double height = terrain(point.x(), point.y());
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * i / kDirections;
    double before = height;
    for (int k = 1; k <= kSteps; ++k) {
      const double distance = length * kEdgeRadius * k / kSteps;
      const double here =
          terrain(point.x() + distance * std::cos(angle), point.y() + distance * std::sin(angle));
      if (jumps(here, before, length * kMinEdgeHeight)) return true;
      before = here;
    }
  }
  return false;
}

Vec3 terrain_normal(const TerrainHeight& terrain, const Vec3& point, double length) {
  const double h = length * 0.005;
  const double slope_x = terrain(point.x() + h, point.y()) - terrain(point.x() - h, point.y());
  const double slope_y = terrain(point.x(), point.y() + h) - terrain(point.x(), point.y() - h);
  return Vec3(-slope_x, -slope_y, 2.0 * h).normalized();
}

}  // namespace

bool is_edge_landing(const TerrainHeight& terrain, const Vec3& point, const Vec3& normal,
                     const Scale& scale) {
  if (edge_in_reach(terrain, point, scale.length)) return true;
  return !(normal.dot(terrain_normal(terrain, point, scale.length)) >= std::cos(kMaxTurn));
}

}  // namespace surefoot::evaluation
