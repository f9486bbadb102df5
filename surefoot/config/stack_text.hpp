#pragma once

#include "surefoot/control/stack_options.hpp"

#include <string>

namespace surefoot::config {

/// The stack with every parameter of its tasks, also those that were left to their defaults.
[[nodiscard]] control::StackOptions with_defaults(control::StackOptions stack);

/// The stack as a stack file that needs no other file; load_stack gives the same levels again.
[[nodiscard]] std::string stack_yaml(const control::StackOptions& stack);

/// Of the levels, highest first.
[[nodiscard]] std::vector<std::string> level_names(const control::StackOptions& stack);

}  // namespace surefoot::config
