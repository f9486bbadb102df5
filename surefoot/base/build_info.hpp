#pragma once

#include <string_view>

namespace surefoot {

/// What the build knows about itself; set by CMake. A wheel names no folders: it can lie anywhere.
struct BuildInfo {
  std::string_view version;             ///< as in project(VERSION …)
  std::string_view commit;              ///< of git, "-dirty" if files differ from it; may be empty
  std::string_view source_data;         ///< source tree: holds robots/, stacks/ and scenarios/
  std::string_view installed_data;      ///< the same folders, where an installation puts them
  std::string_view robot_packages;      ///< holds example-robot-data/robots/…: URDF and meshes
  std::string_view robot_requirements;  ///< Python packages that bring them: "NAME==VERSION …"
};

[[nodiscard]] const BuildInfo& build_info();

}  // namespace surefoot
