#include "surefoot/config/data_directory.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

// Of a program that is linked with an installed package, which may have been moved.
extern "C" [[gnu::weak]] const char* const surefoot_package_data;

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

/// The file that holds this code: the program, or a module that another program has loaded.
fs::path own_file() {
  static const char kHere = 0;
  Dl_info place{};
  link_map* object = nullptr;
  const int found = dladdr1(&kHere, &place, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP);
  std::error_code unknown;
  if (found == 0 || object->l_name[0] == '\0') return fs::read_symlink("/proc/self/exe", unknown);
  return fs::absolute(object->l_name, unknown);
}

/// Where the program or module is installed: beside its share/. A program's bin/ is left out.
fs::path own_folder() {
  const fs::path folder = own_file().parent_path();
  return folder.filename() == "bin" ? folder.parent_path() : folder;
}

/// Where the build found the robots; of a wheel, the packages beside ours.
std::vector<fs::path> built_packages() {
  if (!build_info().robot_packages.empty()) return {build_info().robot_packages};
  const fs::path site = own_folder().parent_path();
  return {site / "cmeel.prefix" / "share", site};
}

}  // namespace

std::vector<fs::path> data_directories() {
  if (const char* chosen = std::getenv("SUREFOOT_DATA_DIR")) return {chosen};
  std::vector<fs::path> places{own_folder() / "share" / "surefoot"};
  if (&surefoot_package_data != nullptr) places.emplace_back(surefoot_package_data);
  for (const std::string_view built : {build_info().source_data, build_info().installed_data}) {
    if (!built.empty()) places.emplace_back(built);
  }
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
  if (folders.empty()) folders = built_packages();
  for (fs::path& folder : listed_in("ROS_PACKAGE_PATH")) folders.push_back(std::move(folder));
  for (const fs::path& prefix : listed_in("AMENT_PREFIX_PATH")) folders.push_back(prefix / "share");
  return folders;
}

}  // namespace surefoot::config
