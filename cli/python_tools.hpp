#pragma once

#include <string>
#include <vector>

/// The Python packages beside the program: they make reports and films of logs, and many runs.
namespace surefoot::cli {

/// Throws Error if they can't be started; `option` is what asks for them.
void check_has_python(const std::string& option);

/// Throws Error if no film can be made, or none of such a name, for the reason that it says.
void check_can_film(const std::string& file);

/// Films a log. False if that failed, which is then told on standard error.
[[nodiscard]] bool film(const std::string& log, const std::string& file);

/// Writes the report of a log into a folder that nobody else writes to, with its pictures, which
/// take most of its time, or without. False if that failed, which is then told on standard error.
[[nodiscard]] bool write_report(const std::string& log, const std::string& folder, bool pictures);

/// Goes on as a Python module that starts this program for each run. ^C and SIGTERM wait until it
/// takes them. Throws Error if it can't be started; `option` is what asks for it.
[[noreturn]] void become_python(const std::string& option, const std::string& module,
                                const std::vector<std::string>& words);

}  // namespace surefoot::cli
