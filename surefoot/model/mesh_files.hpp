#pragma once

#include "surefoot/model/description.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot {

/// Where the meshes of a URDF are looked for.
struct MeshFolders {
  std::vector<std::filesystem::path> packages;  ///< folders that hold packages, or are one
  std::filesystem::path urdf;  ///< the URDF's own folder; empty: it came from elsewhere, in a log
};

[[nodiscard]] MeshFolders mesh_folders(const RobotDescription& description);

/// Where a mesh may lie, the likeliest first. `package://NAME/…` and `model://NAME/…`: in a package
/// of that name in, or as, a folder of packages, or in a folder of that name above the URDF's. Any
/// other name is a path, from the URDF's folder if it is relative, and means nothing where that
/// folder is not known.
[[nodiscard]] std::vector<std::filesystem::path> mesh_places(const std::string& uri,
                                                             const MeshFolders& folders);

/// The first of these places that has a file; empty if none has.
[[nodiscard]] std::filesystem::path find_mesh(const std::string& uri, const MeshFolders& folders);

/// For a message: that there is no such file, and where it was looked for.
[[nodiscard]] std::string missing_text(const std::string& uri, const MeshFolders& folders);

/// A mesh that a URDF names.
struct MeshFile {
  std::string uri;             ///< as it stands there
  std::filesystem::path path;  ///< of the file; empty where there is none, or none that may be read
};

/// The meshes of a URDF, each once, in its order. Only files that are meshes by their name are
/// found: a URDF may come from anywhere. Throws FileError where the text is no XML.
[[nodiscard]] std::vector<MeshFile> mesh_files(const std::string& urdf, const MeshFolders& folders);

}  // namespace surefoot
