#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace surefoot::cli {

/// A command: fills its arguments while parsing, then runs.
using Command = std::function<int()>;

/// `replay`, `explain`, `info` and `mend`.
void add_log_commands(CLI::App& app, Command& chosen);

/// A command that the launcher runs in Python; here it has only its name and help.
void add_python_command(CLI::App& app, Command& chosen, const std::string& name,
                        const std::string& help);

}  // namespace surefoot::cli
