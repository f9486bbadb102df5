#include "surefoot/doctor/found_feet.hpp"

#include "surefoot/doctor/shape_points.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace surefoot::doctor {
namespace {

constexpr double kAsFar = 0.85;       // share of the largest distance that counts as a tie
constexpr double kUsualRadius = 0.1;  // share of the shank; robots that are known have 0.08 to 0.13
constexpr double kMostRadius = 0.25;  // share of the shank, of a shape that tells the radius

Vec3 across(const Vec3& point, const Vec3& axis) { return point - axis * axis.dot(point); }

double distance_from_axis(const Vec3& point, const Vec3& axis) {
  return across(point, axis).norm();
}

bool is_called_foot(const std::string& name) {
  std::string lower = name;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::any_of(std::array{"foot", "toe", "ankle", "tip"}, [&](const char* word) {
    return lower.find(word) != std::string::npos;
  });
}

/// Rounding up, as the sphere must enclose the foot.
double up_to_millimetres(double length) { return 1e-3 * std::ceil(1e3 * length - 0.1); }

}  // namespace

FootFinder::FootFinder(const model::Urdf& urdf, const std::map<std::string, model::Weld>& welds)
    : urdf_(urdf), welds_(welds), shapes_(model::collision_shapes(urdf)) {}

Foot FootFinder::foot_behind(const model::UrdfJoint& knee) const {
  const auto distance = [&](const model::UrdfLink& link) {
    const model::Weld& weld = welds_.at(link.name);
    return weld.body == knee.child ? distance_from_axis(weld.p, knee.axis) : -1.0;
  };
  double farthest = 0.0;
  for (const model::UrdfLink& link : urdf_.links) farthest = std::max(farthest, distance(link));
  const model::UrdfLink* best = urdf_.find_link(knee.child);
  for (const model::UrdfLink& link : urdf_.links) {
    if (distance(link) < kAsFar * farthest) continue;
    const int name = int{is_called_foot(link.name)} - int{is_called_foot(best->name)};
    const bool is_as_far = distance(*best) >= kAsFar * farthest;
    if (!is_as_far || name > 0 || (name == 0 && distance(link) > distance(*best))) best = &link;
  }
  Foot foot{.link = best->name, .line = best->line, .guessed_from = {}};
  find_sphere(knee, foot);
  return foot;
}

double FootFinder::radius_beyond(const model::CollisionShape& shape, const Vec3& down) const {
  if (shape.kind == "sphere") return shape.radius;
  double radius = 0.0;
  for (const Vec3& point : shape_points(shape, urdf_)) {
    if (point.dot(down) > 0.0) radius = std::max(radius, point.norm());
  }
  return radius;
}

/// The sphere at the leg's end, whatever link of the shank has it; else a guess.
void FootFinder::find_sphere(const model::UrdfJoint& knee, Foot& foot) const {
  const model::Weld& at = welds_.at(foot.link);
  const double reach = distance_from_axis(at.p, knee.axis);
  double farthest = 0.5 * reach;
  foot.guessed_from = kNoShape;
  foot.radius = up_to_millimetres(kUsualRadius * reach);
  bool is_sphere = false;
  for (const model::CollisionShape& shape : shapes_) {
    const model::Weld& weld = welds_.at(shape.link);
    if (weld.body != knee.child) continue;
    const Vec3 center = weld.p + weld.R * shape.center;
    if (shape.kind == "sphere" && distance_from_axis(center, knee.axis) > farthest) {
      farthest = distance_from_axis(center, knee.axis);
      foot.radius = shape.radius;
      foot.center = at.R.transpose() * (center - at.p);
      foot.guessed_from.clear();
      is_sphere = true;
    } else if (!is_sphere && shape.link == foot.link) {
      foot.guessed_from = "a " + shape.kind;
      const double radius =
          radius_beyond(shape, at.R.transpose() * across(at.p, knee.axis).normalized());
      if (radius > 0.0 && radius < kMostRadius * reach) foot.radius = up_to_millimetres(radius);
    }
  }
}

}  // namespace surefoot::doctor
