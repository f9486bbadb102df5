#pragma once

#include "surefoot/signals/user_command.hpp"

#include <string>
#include <utility>

namespace surefoot::python {

/// A command that may name its gait; `UserCommand` in Python.
struct NamedCommand : UserCommand {
  NamedCommand() = default;
  NamedCommand(const UserCommand& command) : UserCommand(command) {}

  std::string gait_name;  ///< empty: `gait` says which
};

}  // namespace surefoot::python
