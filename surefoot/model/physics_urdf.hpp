#pragma once

#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::model {

/// Begins the note on links whose inertia is impossible alone.
inline constexpr std::string_view kUnsoundInertia = "alone, no body can have the inertia of:";

/// The parts of a URDF that physics needs; faults elsewhere in it don't matter.
struct PhysicsUrdf {
  /// The URDF as MuJoCo reads it: links with inertias and collision shapes, meshes by the files
  /// found, joints with axes and stops. Numbers are copied as text. If a link's inertia is
  /// impossible alone, the first link of its body carries the inertia of the whole body.
  std::string xml;
  std::vector<std::string> notes;  ///< what was ignored, a line each
};

/// Reads the file of `urdf` again. Throws FileError, with file and line, if a collision shape is
/// unknown, has no size or lacks its mesh, or if a joint's stops are inconsistent.
[[nodiscard]] PhysicsUrdf physics_urdf(const Urdf& urdf, const MeshFolders& folders);

}  // namespace surefoot::model
