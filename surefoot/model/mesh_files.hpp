#pragma once

#include "surefoot/model/description.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::model {

/// Search folders for a URDF's meshes.
struct MeshFolders {
  std::vector<std::filesystem::path> packages;  ///< folders that hold packages, or are packages
  std::filesystem::path urdf;  ///< the URDF's own folder; empty if it came from a log
};

[[nodiscard]] MeshFolders mesh_folders(const RobotDescription& description);

/// Possible places of a mesh, the likeliest first. `package://NAME/…` and `model://NAME/…`: in a
/// package NAME in (or being) a folder of packages, else in the nearest folder NAME that lies in
/// the URDF's folder or in one above it. Any other
/// name is a path, relative to the URDF's folder; without that folder it has no place.
[[nodiscard]] std::vector<std::filesystem::path> mesh_places(const std::string& uri,
                                                             const MeshFolders& folders);

/// The first of these places with a file; empty if there is none.
[[nodiscard]] std::filesystem::path find_mesh(const std::string& uri, const MeshFolders& folders);

/// What installs the package of a missing file, "`pip install …` installs it"; empty if that is not
/// known.
[[nodiscard]] std::string installed_by(const std::string& uri, const MeshFolders& folders);

/// Error text: the missing file, what installs it if that is known, and where it was searched.
[[nodiscard]] std::string missing_text(const std::string& uri, const MeshFolders& folders);

/// A mesh named in a URDF.
struct MeshFile {
  std::string uri;             ///< as written in the URDF
  std::filesystem::path path;  ///< empty if there is no file, or it may not be read
};

/// The meshes of a URDF, each once, in its order. Only files with a mesh's extension are found, as
/// a URDF may come from anywhere. Throws FileError if the text is not XML.
[[nodiscard]] std::vector<MeshFile> mesh_files(const std::string& urdf, const MeshFolders& folders);

}  // namespace surefoot::model
