#pragma once

#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/urdf.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// What physics needs of a URDF, and nothing else, so that nothing else can be wrong in it.
struct PhysicsUrdf {
  /// The URDF again, as MuJoCo reads one: links with inertias and collision shapes, meshes by the
  /// files that were found, joints with their axes and stops. Numbers stand as they were written.
  /// The inertia of a body one of whose links has an impossible one is that of its first link.
  std::string xml;
  std::vector<std::string> notes;  ///< what was left out, a line each
};

/// Reads the file of `urdf` again. Throws FileError, with file and line, if a collision shape is
/// none, has no size or its mesh is not found, or if a joint's stops make no sense.
[[nodiscard]] PhysicsUrdf physics_urdf(const Urdf& urdf, const MeshFolders& folders);

}  // namespace surefoot
