#include "surefoot/config/data_directory.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/base/error.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

namespace surefoot {

namespace fs = std::filesystem;

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

fs::path robot_package_directory() {
  if (const char* chosen = std::getenv("SUREFOOT_ROBOT_PACKAGES")) return chosen;
  return build_info().robot_packages;
}

}  // namespace surefoot
