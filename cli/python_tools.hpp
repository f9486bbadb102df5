#pragma once

#include <string>
#include <vector>

/// Starts the Python packages, which make reports and films of logs, and run many seeds.
namespace surefoot::cli {

/// Throws Error if they can't be started; `option` is the command's option that needs them.
void check_has_python(const std::string& option);

/// Throws Error, with the reason, if no film can be made with this file name.
void check_can_film(const std::string& file);

/// Films a log. Prints an error and returns false if that fails.
[[nodiscard]] bool film(const std::string& log, const std::string& file);

/// Writes the report of a log into a folder that no other process writes to. `pictures` take most
/// of its time. Prints an error and returns false if that fails.
[[nodiscard]] bool write_report(const std::string& log, const std::string& folder, bool pictures);

/// Replaces this process by a Python module that starts this program for each run. ^C and SIGTERM
/// stay blocked until the module handles them. Throws Error if it can't be started; `option`: as
/// above.
[[noreturn]] void become_python(const std::string& option, const std::string& module,
                                const std::vector<std::string>& words);

}  // namespace surefoot::cli
