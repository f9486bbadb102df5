#pragma once

#include "server/web_server.hpp"
#include "surefoot/model/mesh_files.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// The robot's URDF and meshes, for the page.
class ViewRobot {
 public:
  /// Of a URDF that is no XML there are no meshes.
  ViewRobot(std::string urdf, const model::MeshFolders& folders);

  [[nodiscard]] const std::vector<model::MeshFile>& meshes() const { return meshes_; }
  /// The answer for /api/robot.urdf and /api/mesh/ID.
  [[nodiscard]] WebAnswer get(std::string_view path) const;

 private:
  [[nodiscard]] WebAnswer mesh(std::string_view id) const;

  std::string urdf_;
  std::vector<model::MeshFile> meshes_;
};

/// That the page shows primitives for meshes that are missing, and where they are looked for; empty
/// where none is.
[[nodiscard]] std::string missing_meshes_text(const std::vector<model::MeshFile>& meshes);

}  // namespace surefoot::server
