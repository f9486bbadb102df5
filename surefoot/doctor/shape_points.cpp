#include "surefoot/doctor/shape_points.hpp"

#include "surefoot/doctor/mesh_vertices.hpp"

#include <cmath>

namespace surefoot::doctor {
namespace {

std::vector<Vec3> box(const Vec3& size) {
  std::vector<Vec3> points;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double z : {-0.5, 0.5}) points.push_back(size.cwiseProduct(Vec3(x, y, z)));
    }
  }
  return points;
}

std::vector<Vec3> round(const model::CollisionShape& shape) {
  constexpr int kPoints = 16;  // of a rim
  std::vector<Vec3> points;
  for (const double z : {-0.5 * shape.length, 0.5 * shape.length}) {
    for (int i = 0; i < kPoints; ++i) {
      const double angle = 2.0 * kPi * i / kPoints;
      points.emplace_back(shape.radius * std::cos(angle), shape.radius * std::sin(angle), z);
    }
    if (shape.kind == "capsule") points.emplace_back(0.0, 0.0, z + std::copysign(shape.radius, z));
  }
  return points;
}

/// In the shape's own axes.
std::vector<Vec3> own_points(const model::CollisionShape& shape, const model::Urdf& urdf) {
  if (!shape.mesh.empty()) return mesh_vertices(shape, urdf);
  if (shape.kind == "box") return box(shape.size);
  if (shape.kind == "cylinder" || shape.kind == "capsule") return round(shape);
  return {};
}

}  // namespace

std::vector<Vec3> shape_points(const model::CollisionShape& shape, const model::Urdf& urdf) {
  std::vector<Vec3> points = own_points(shape, urdf);
  for (Vec3& point : points) point = shape.center + shape.R * point;
  return points;
}

}  // namespace surefoot::doctor
