#pragma once

#include "surefoot/config/config_tree.hpp"

#include <string>

namespace surefoot::config {

/// A configuration as JSON: numbers and booleans as such, everything else as strings.
[[nodiscard]] std::string to_json(const ConfigNode& tree);

}  // namespace surefoot::config
