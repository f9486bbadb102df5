#include "surefoot/evaluation/landing.hpp"

#include <cmath>

namespace surefoot {
namespace {

constexpr double kReach = 0.02;  // [m]
constexpr double kJump = 0.015;  // [m]
constexpr double kMaxLean = 15.0 * kPi / 180.0;

bool jumps(double height, double neighbour) { return !(std::abs(height - neighbour) <= kJump); }

// An edge within the circle's disc crosses the circle, or it surrounds a spike that the inner
// circle meets.
bool edge_on_circle(const TerrainHeight& terrain, const Vec3& centre, double radius) {
  const int count = static_cast<int>(std::ceil(2.0 * kPi * radius / 0.004));
  const auto height = [&](int i) {
    const double angle = 2.0 * kPi * i / count;
    return terrain(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle));
  };
  const double first = height(0);
  double before = first;
  for (int i = 1; i < count; ++i) {
    const double here = height(i);
    if (jumps(here, before)) return true;
    before = here;
  }
  return jumps(first, before);
}

Vec3 terrain_normal(const TerrainHeight& terrain, const Vec3& point) {
  constexpr double h = 0.005;
  const double slope_x = terrain(point.x() + h, point.y()) - terrain(point.x() - h, point.y());
  const double slope_y = terrain(point.x(), point.y() + h) - terrain(point.x(), point.y() - h);
  return Vec3(-slope_x, -slope_y, 2.0 * h).normalized();
}

}  // namespace

bool is_edge_landing(const TerrainHeight& terrain, const Vec3& point, const Vec3& normal) {
  for (const double radius : {kReach, kReach / 2.0, kReach / 4.0}) {
    if (edge_on_circle(terrain, point, radius)) return true;
  }
  return !(normal.dot(terrain_normal(terrain, point)) >= std::cos(kMaxLean));
}

}  // namespace surefoot
