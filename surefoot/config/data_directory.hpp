#pragma once

#include <filesystem>
#include <vector>

namespace surefoot::config {

/// Where robots/, stacks/ and scenarios/ may be, in order of priority: $SUREFOOT_DATA_DIR alone if
/// it is set; else share/surefoot beside the running program (or its bin/) or Python module; then
/// that of the CMake package, the source tree and the install prefix, where the build has them.
[[nodiscard]] std::vector<std::filesystem::path> data_directories();

/// The folder that holds robots/, stacks/ and scenarios/. Throws FileError, naming the places
/// tried, if there is none.
[[nodiscard]] std::filesystem::path data_directory();

/// Folders searched for `package://NAME/…`: those of $SUREFOOT_ROBOT_PACKAGES, or else the build's
/// or those beside a wheel, which hold example-robot-data; then those of $ROS_PACKAGE_PATH, and
/// share/ in those of $AMENT_PREFIX_PATH. Each variable is a list separated by `:`.
[[nodiscard]] std::vector<std::filesystem::path> package_directories();

}  // namespace surefoot::config
