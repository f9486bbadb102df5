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
  /// A URDF that is not XML has no meshes.
  ViewRobot(std::string urdf, const model::MeshFolders& folders);

  [[nodiscard]] const std::vector<model::MeshFile>& meshes() const { return meshes_; }
  /// The answer for /api/robot.urdf and /api/mesh/ID.
  [[nodiscard]] WebAnswer get(std::string_view path) const;

 private:
  [[nodiscard]] WebAnswer mesh(std::string_view id) const;

  std::string urdf_;
  std::vector<model::MeshFile> meshes_;
};

/// Text on missing meshes, which are replaced by primitives, and where to look; empty: none.
[[nodiscard]] std::string missing_meshes_text(const std::vector<model::MeshFile>& meshes);

}  // namespace surefoot::server
