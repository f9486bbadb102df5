#pragma once

#include "surefoot/config/config_tree.hpp"

#include <string>

namespace surefoot::config {

/// A configuration as JSON: numbers and true/false as such, everything else as text.
[[nodiscard]] std::string to_json(const ConfigNode& tree);

}  // namespace surefoot::config
