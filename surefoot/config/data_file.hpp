#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace surefoot::config {

/// Names of the files in a data folder, without ".yaml", sorted.
/// `folder` is "robots", "stacks", "gaits", "scenarios" or "randomisations".
[[nodiscard]] std::vector<std::string> list_data(const std::string& folder);

/// The `description:` of a data file; empty if there is none. Throws FileError.
[[nodiscard]] std::string describe_data(const std::string& folder, const std::string& name);

/// The file of a name: a path if it ends in ".yaml" or ".yml", otherwise that file of the data
/// folder. A path is tried from the working folder, from `beside`, the folder of the file that
/// contains the name, then in the data folder. Throws UnknownNameError with the valid names.
[[nodiscard]] std::filesystem::path find_data_file(const std::string& folder,
                                                   const std::string& name,
                                                   const std::filesystem::path& beside = {});

}  // namespace surefoot::config
