#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::config {

/// Names of the files that a data folder holds, without ".yaml", sorted.
/// `folder` is "robots", "stacks", "scenarios" or "randomisations".
[[nodiscard]] std::vector<std::string> list_data(const std::string& folder);

/// What a data file says of itself under `description:`; empty if nothing. Throws FileError.
[[nodiscard]] std::string describe_data(const std::string& folder, const std::string& name);

/// The file that a name stands for: a path if it ends in ".yaml" or ".yml", otherwise the file of
/// that name in the data folder. A path is tried as it stands, then from `beside`, the folder of
/// the file that names it. Throws UnknownNameError, with the names that exist, if there is no such
/// file.
[[nodiscard]] std::filesystem::path find_data_file(const std::string& folder,
                                                   const std::string& name,
                                                   const std::filesystem::path& beside = {});

}  // namespace surefoot::config
