#include "surefoot/doctor/mesh_vertices.hpp"

#include "surefoot/config/data_directory.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/mesh_points.hpp"

#include <filesystem>

namespace surefoot::doctor {

std::vector<Vec3> mesh_vertices(const model::CollisionShape& shape, const model::Urdf& urdf) {
  const model::MeshFolders folders{.packages = config::package_directories(),
                                   .urdf = std::filesystem::absolute(urdf.path).parent_path()};
  std::vector<Vec3> vertices = model::mesh_points(model::find_mesh(shape.mesh, folders));
  for (Vec3& vertex : vertices) vertex = vertex.cwiseProduct(shape.scale);
  return vertices;
}

}  // namespace surefoot::doctor
