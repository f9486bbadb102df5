#pragma once

#include <string>

/// What the Python packages beside the program make of a log: reports and films.
namespace surefoot {

/// Throws Error if they can't be started; `option` is what asks for them.
void check_has_python(const std::string& option);

/// Throws Error if no film can be made, or none of such a name, for the reason that it says.
void check_can_film(const std::string& file);

/// Films a log. False if that failed, which is then told on standard error.
[[nodiscard]] bool film(const std::string& log, const std::string& file);

/// Of a report.
struct ReportOptions {
  bool pictures = true;  ///< with strip and clip, which take most of its time
  bool quiet = false;    ///< does not tell on standard error that the page can be opened meanwhile
};

/// Writes the report of a log into a folder that nobody else writes to. False if that failed,
/// which is then told on standard error.
[[nodiscard]] bool write_report(const std::string& log, const std::string& folder,
                                const ReportOptions& options = {});

}  // namespace surefoot
