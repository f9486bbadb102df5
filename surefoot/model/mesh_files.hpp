#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot {

/// A mesh that a URDF names.
struct MeshFile {
  std::string uri;             ///< as it stands there
  std::filesystem::path path;  ///< of the file; empty where there is none, or none that may be read
};

/// The meshes of a URDF, each once, in its order. Only `package://` names are looked for, below
/// `packages`, and only files that are meshes by their name: a URDF may come from anywhere. Throws
/// FileError where the text is no XML.
[[nodiscard]] std::vector<MeshFile> mesh_files(const std::string& urdf,
                                               const std::filesystem::path& packages);

}  // namespace surefoot
