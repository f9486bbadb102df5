#include "surefoot/evaluation/landing.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kReach = 0.02;     // [m]
constexpr double kMinJump = 0.015;  // [m]
constexpr double kMaxLean = 15.0 * kPi / 180.0;

bool jumps(double height, double neighbour, double least) {
  return !(std::abs(height - neighbour) <= least);
}

// Searches outwards from the point.
bool edge_in_reach(const TerrainHeight& terrain, const Vec3& point, double length) {
  constexpr int kDirections = 32, kPlaces = 5;
  const double height = terrain(point.x(), point.y());
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * kPi * i / kDirections;
    double before = height;
    for (int k = 1; k <= kPlaces; ++k) {
      const double distance = length * kReach * k / kPlaces;
      const double here =
          terrain(point.x() + distance * std::cos(angle), point.y() + distance * std::sin(angle));
      if (jumps(here, before, length * kMinJump)) return true;
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
  return !(normal.dot(terrain_normal(terrain, point, scale.length)) >= std::cos(kMaxLean));
}

}  // namespace surefoot::evaluation
