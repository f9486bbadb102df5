#pragma once

#include <filesystem>
#include <vector>

namespace surefoot {

/// Where robots/, stacks/ and scenarios/ are looked for, first match first: $SUREFOOT_DATA_DIR,
/// beside the running program's installation, the source tree, the installation's prefix.
[[nodiscard]] std::vector<std::filesystem::path> data_directories();

/// The folder that holds robots/, stacks/ and scenarios/. Throws FileError, naming the places
/// tried, if there is none.
[[nodiscard]] std::filesystem::path data_directory();

/// The folder below which `package://example-robot-data/…` lies: $SUREFOOT_ROBOT_PACKAGES, or the
/// one that this build was made with.
[[nodiscard]] std::filesystem::path robot_package_directory();

}  // namespace surefoot
