#include "surefoot/config/description_file.hpp"

#include "surefoot/config/data_directory.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/urdf_reader.hpp"
#include "surefoot/simulation/mjcf_urdf.hpp"

namespace surefoot::config {

std::string find_description(const std::string& name, const std::filesystem::path& folder) {
  // It is looked for as its meshes are.
  const model::MeshFolders folders{.packages = package_directories(), .urdf = folder};
  const std::filesystem::path found = model::find_mesh(name, folders);
  if (found.empty())
    throw MissingDescription(model::missing_text(name, folders),
                             model::installed_by(name, folders));
  return found.string();
}

std::string urdf_of_mjcf_named(const std::string& name, const std::string& path) {
  const bool is_of_package = name.find("://") != std::string::npos;
  return simulation::urdf_of_mjcf(path, is_of_package ? name.substr(0, name.rfind('/')) : "");
}

DescriptionFile read_description(const std::string& name) {
  DescriptionFile file{.path = name, .urdf = {}};
  if (name.find("://") != std::string::npos) file.path = find_description(name, {});
  if (model::root_of_xml(file.path, "description") == "mujoco")
    file.urdf = urdf_of_mjcf_named(name, file.path);
  return file;
}

}  // namespace surefoot::config
