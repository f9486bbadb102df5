#include "surefoot/config/data_directory.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <cstdlib>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

namespace surefoot::config {

namespace fs = std::filesystem;

namespace {

/// The folders in an environment variable like PATH.
std::vector<fs::path> listed_in(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::istringstream list(value == nullptr ? "" : value);
  for (std::string folder; std::getline(list, folder, ':');) {
    while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

}  // namespace

std::vector<fs::path> data_directories() {
  std::vector<fs::path> places;
  if (const char* chosen = std::getenv("SUREFOOT_DATA_DIR")) return {chosen};
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  if (!unknown) places.push_back(program.parent_path().parent_path() / "share" / "surefoot");
  places.emplace_back(build_info().source_data);
  places.emplace_back(build_info().installed_data);
  return places;
}

fs::path data_directory() {
  std::string tried;
  for (const fs::path& place : data_directories()) {
    std::error_code ignored;
    if (fs::is_directory(place / "robots", ignored)) return place;
    tried += " " + place.string();
  }
  throw FileError("no folder robots/ in any of:" + tried +
                  "; set SUREFOOT_DATA_DIR to where it is");
}

std::vector<fs::path> package_directories() {
  std::vector<fs::path> folders = listed_in("SUREFOOT_ROBOT_PACKAGES");
  if (folders.empty()) folders.emplace_back(build_info().robot_packages);
  for (fs::path& folder : listed_in("ROS_PACKAGE_PATH")) folders.push_back(std::move(folder));
  for (const fs::path& prefix : listed_in("AMENT_PREFIX_PATH")) folders.push_back(prefix / "share");
  return folders;
}

}  // namespace surefoot::config
