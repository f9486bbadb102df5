#include "surefoot/model/mesh_files.hpp"

#include "surefoot/base/error.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPackage = "package://";
constexpr std::array<std::string_view, 5> kMeshes{".dae", ".stl", ".obj", ".glb", ".gltf"};

fs::path found(const std::string& uri, const fs::path& packages) {
  if (!uri.starts_with(kPackage)) return {};
  const fs::path inside = fs::path(uri.substr(kPackage.size())).lexically_normal();
  std::string extension = inside.extension().string();
  for (char& letter : extension)
    letter = letter >= 'A' && letter <= 'Z' ? char(letter + 32) : letter;
  const bool leaves = inside.is_absolute() || inside.empty() || *inside.begin() == "..";
  if (leaves || std::ranges::find(kMeshes, extension) == kMeshes.end()) return {};
  std::error_code error;
  const fs::path path = packages / inside;
  return fs::is_regular_file(path, error) ? path : fs::path();
}

void collect(const tinyxml2::XMLElement& element, const fs::path& packages,
             std::vector<MeshFile>& meshes) {
  for (const auto* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    const char* name = child->Attribute("filename");
    if (std::string_view(child->Name()) == "mesh" && name != nullptr &&
        std::ranges::find(meshes, name, &MeshFile::uri) == meshes.end()) {
      meshes.push_back({name, found(name, packages)});
    }
    collect(*child, packages, meshes);
  }
}

}  // namespace

std::vector<MeshFile> mesh_files(const std::string& urdf, const fs::path& packages) {
  tinyxml2::XMLDocument document;
  if (document.Parse(urdf.c_str(), urdf.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    throw FileError("the URDF is not XML: " + std::string(document.ErrorStr()));
  }
  std::vector<MeshFile> meshes;
  collect(*document.RootElement(), packages, meshes);
  return meshes;
}

}  // namespace surefoot
