#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/model/description.hpp"

#include <filesystem>
#include <string>

namespace surefoot::config {

/// Reads robots/*.yaml by name or path; a path may be relative to `beside`. Throws Error, naming
/// the line, also on frames, links and joints that the URDF does not have.
[[nodiscard]] model::RobotDescription load_robot(const std::string& name_or_path,
                                                 const std::filesystem::path& beside = {});

}  // namespace surefoot::config
