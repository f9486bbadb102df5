#pragma once

#include "surefoot/control/stack_options.hpp"

#include <string>

namespace surefoot::config {

/// The stack with every parameter of its tasks, including defaults.
[[nodiscard]] control::StackOptions with_defaults(control::StackOptions stack);

/// The stack as a self-contained stack file; load_stack reads the same levels.
[[nodiscard]] std::string stack_yaml(const control::StackOptions& stack);

/// Names of the levels, highest priority first.
[[nodiscard]] std::vector<std::string> level_names(const control::StackOptions& stack);

}  // namespace surefoot::config
