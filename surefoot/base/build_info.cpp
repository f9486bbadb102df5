#include "surefoot/base/build_info.hpp"

#include "surefoot_commit.hpp"  // made by cmake/commit.cmake

namespace surefoot {

const BuildInfo& build_info() {
  static constexpr BuildInfo kInfo = {
      .version = SUREFOOT_VERSION,
      .commit = SUREFOOT_COMMIT,
      .source_data = SUREFOOT_SOURCE_DATA,
      .installed_data = SUREFOOT_INSTALLED_DATA,
      .robot_packages = SUREFOOT_ROBOT_PACKAGES,
      .robot_requirements = SUREFOOT_ROBOT_REQUIREMENTS,
  };
  return kInfo;
}

}  // namespace surefoot
