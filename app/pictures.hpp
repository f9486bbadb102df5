#pragma once

#include "surefoot/view/report.hpp"

#include <functional>
#include <string>

namespace surefoot {

/// The Python that the launcher names in $SUREFOOT_PYTHON, which makes pictures of logs; empty
/// where the program was started without it.
[[nodiscard]] std::string pictures_python();

/// Throws Error if no film can be made, or none of such a name, for the reason that it says.
void check_can_film(const std::string& file);

/// Makes the pictures of a log for its report. What can't be made is said in `why_none`: a report
/// is written all the same.
[[nodiscard]] ReportPictures make_pictures(const std::string& log);

/// Films a log. False if that failed, which is then told on standard error.
[[nodiscard]] bool film(const std::string& log, const std::string& file);

/// Writes the report of a log, then its pictures into it; `is_there` gets the path of the page that
/// has none yet. Returns the page's path; throws as `write_report`.
std::string write_illustrated_report(
    const std::string& log, const std::string& folder,
    const std::function<void(const std::string& page)>& is_there = {});

/// Of a page that has no pictures yet, on standard error.
void tell_pictures_come(const std::string& page);

}  // namespace surefoot
