#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace surefoot::cli {

/// A command: fills its arguments while parsing, then runs.
using Command = std::function<int()>;

/// `replay`, `explain`, `info` and `mend`.
void add_log_commands(CLI::App& app, Command& chosen);

/// A command that is a Python module, which reads its own arguments, and `first` before them.
void add_python_command(CLI::App& app, Command& chosen, const std::string& name,
                        const std::string& help, const std::string& module,
                        const std::vector<std::string>& first = {});

}  // namespace surefoot::cli
