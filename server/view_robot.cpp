#include "server/view_robot.hpp"

#include "server/web_answer.hpp"
#include "surefoot/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace surefoot::server {
namespace {

constexpr std::string_view kUrdf = "/api/robot.urdf";
constexpr std::string_view kMesh = "/api/mesh/";

std::vector<model::MeshFile> meshes_of(const std::string& urdf, const model::MeshFolders& folders) {
  try {
    return model::mesh_files(urdf, folders);
  } catch (const FileError&) {
    return {};  // the page reports it
  }
}

std::string media_type(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".dae") return "model/vnd.collada+xml";
  if (extension == ".glb") return "model/gltf-binary";
  return extension == ".gltf" ? "model/gltf+json" : "application/octet-stream";
}

}  // namespace

ViewRobot::ViewRobot(std::string urdf, const model::MeshFolders& folders)
    : urdf_(std::move(urdf)), meshes_(meshes_of(urdf_, folders)) {}

std::string missing_meshes_text(const std::vector<model::MeshFile>& meshes) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> names;
  for (const model::MeshFile& mesh : meshes)
    if (mesh.path.empty()) names.push_back(mesh.uri.substr(mesh.uri.rfind('/') + 1));
  if (names.empty()) return "";
  std::string text = "the page shows primitives, as these meshes are missing: ";
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i)
    text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  return text + "; $SUREFOOT_ROBOT_PACKAGES and $ROS_PACKAGE_PATH say where they are looked for";
}

WebAnswer ViewRobot::get(std::string_view path) const {
  if (path == kUrdf) return {200, "application/xml", urdf_};
  if (path.starts_with(kMesh)) return mesh(path.substr(kMesh.size()));
  return refusal(404, "there is no " + std::string(path) + " here");
}

WebAnswer ViewRobot::mesh(std::string_view id) const {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  if (error != std::errc() || end != id.data() + id.size() || number >= meshes_.size()) {
    return refusal(404, "there is no such mesh; the robot has " + std::to_string(meshes_.size()));
  }
  const model::MeshFile& mesh = meshes_[number];
  std::ostringstream bytes;
  if (mesh.path.empty() || !(bytes << std::ifstream(mesh.path, std::ios::binary).rdbuf())) {
    return refusal(404, "the mesh " + mesh.uri + " is missing on this machine");
  }
  return {200, media_type(mesh.path), bytes.str()};
}

}  // namespace surefoot::server
