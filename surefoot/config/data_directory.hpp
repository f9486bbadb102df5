#pragma once

#include <filesystem>
#include <vector>

namespace surefoot::config {

/// Where robots/, stacks/ and scenarios/ are looked for, first match first: $SUREFOOT_DATA_DIR,
/// beside the running program's installation, the source tree, the installation's prefix.
[[nodiscard]] std::vector<std::filesystem::path> data_directories();

/// The folder that holds robots/, stacks/ and scenarios/. Throws FileError, naming the places
/// tried, if there is none.
[[nodiscard]] std::filesystem::path data_directory();

/// Folders in which `package://NAME/…` is looked for: those of $SUREFOOT_ROBOT_PACKAGES, or the one
/// that this build was made with, which holds example-robot-data; then those of $ROS_PACKAGE_PATH,
/// and share/ in those of $AMENT_PREFIX_PATH. Each variable is a list with `:` between.
[[nodiscard]] std::vector<std::filesystem::path> package_directories();

}  // namespace surefoot::config
