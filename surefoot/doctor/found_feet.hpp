#pragma once

#include "surefoot/doctor/anatomy.hpp"
#include "surefoot/model/collision_shapes.hpp"

namespace surefoot::doctor {

/// Finds the foot of a leg among all that is fixed to its shank.
class FootFinder {
 public:
  /// Throws FileError if the collision shapes can't be read.
  FootFinder(const model::Urdf& urdf, const std::map<std::string, model::Weld>& welds);

  /// The link farthest from the knee's axis, with its sphere; where several are about as far, the
  /// one that is called foot, toe, ankle or tip.
  [[nodiscard]] Foot foot_behind(const model::UrdfJoint& knee) const;

 private:
  void find_sphere(const model::UrdfJoint& knee, Foot& foot) const;
  /// Radius about the foot link's origin of what a shape has beyond it, seen from the knee [m].
  [[nodiscard]] double radius_beyond(const model::CollisionShape& shape, const Vec3& down) const;

  const model::Urdf& urdf_;
  const std::map<std::string, model::Weld>& welds_;
  std::vector<model::CollisionShape> shapes_;
};

}  // namespace surefoot::doctor
