#include "surefoot/config/description_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_directory.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/model/mesh_files.hpp"
#include "surefoot/model/urdf_reader.hpp"
#include "surefoot/simulation/mjcf_urdf.hpp"

namespace surefoot::config {

std::string find_description(const std::string& name, const std::filesystem::path& folder) {
  // It is looked for as its meshes are.
  const model::MeshFolders folders{.packages = package_directories(), .urdf = folder};
  const std::filesystem::path found = model::find_mesh(name, folders);
  if (found.empty()) throw FileError(model::missing_text(name, folders));
  return found.string();
}

std::string urdf_of_mjcf_named(const std::string& name, const std::string& path) {
  const bool is_of_package = name.find("://") != std::string::npos;
  return simulation::urdf_of_mjcf(path, is_of_package ? name.substr(0, name.rfind('/')) : "");
}

namespace {

/// What a robot file names, as ", FILE"; empty: nothing.
std::string named_by(const std::string& robot_file) {
  const ConfigNode tree = parse_yaml_file(robot_file);
  for (const char* key : {"urdf", "mjcf"}) {
    const ConfigNode* given = tree.find(key);
    if (given != nullptr && !given->text.empty()) return ", " + given->text;
  }
  return "";
}

}  // namespace

DescriptionFile read_description(const std::string& name) {
  DescriptionFile file{.path = name, .urdf = {}};
  if (std::filesystem::path(name).extension() == ".yaml" && std::filesystem::is_regular_file(name))
    throw FileError(
        name + " is a robot file, not a URDF or an MJCF; give the one that it names" +
        named_by(name) +
        ", or check the robot file: surefoot run walk_flat --check --set robot=" + name);
  if (name.find("://") != std::string::npos) file.path = find_description(name, {});
  if (model::root_of_xml(file.path, "description") == "mujoco")
    file.urdf = urdf_of_mjcf_named(name, file.path);
  return file;
}

}  // namespace surefoot::config
