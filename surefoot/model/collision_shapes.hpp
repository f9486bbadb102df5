#pragma once

#include "surefoot/model/urdf.hpp"

#include <string>
#include <vector>

namespace surefoot::model {

/// A collision shape of a link.
struct CollisionShape {
  std::string link;
  std::string kind;            ///< sphere, cylinder, box, mesh …
  Vec3 center = Vec3::Zero();  ///< in the link's frame [m]
  double radius = 0.0;         ///< sphere, cylinder, capsule; else half the box's least side [m]
  double length = 0.0;         ///< of a cylinder or capsule [m]
  Vec3 size = Vec3::Zero();    ///< of a box [m]
  std::string mesh;            ///< file of a mesh, as written; else empty
  Mat3 R = Mat3::Identity();   ///< its axes in the link's frame
  Vec3 scale = Vec3::Ones();   ///< of the mesh
  int line = 0;                ///< in the file
};

/// The collision shapes of a URDF, in the order of the file, which is read again; a mesh has radius
/// 0. Throws FileError if the file, an origin or a size can't be read, or a radius or length is
/// negative.
[[nodiscard]] std::vector<CollisionShape> collision_shapes(const Urdf& urdf);

}  // namespace surefoot::model
