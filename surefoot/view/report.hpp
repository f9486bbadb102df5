#pragma once

#include <string>

namespace surefoot {

/// Writes OUTPUT_DIR/index.html from a log alone: one page without scripts or network, with the
/// run's numbers beside those of the paper and figures after the paper's Fig. 4 and Fig. 6,
/// footprints, torques, level residuals and times. The folder is made once the log was read. A log
/// that was cut off is shown as far as it goes, and the page says so. Returns the page's path.
///
/// Throws FileError if the log can't be read or the page can't be written.
std::string write_report(const std::string& log_path, const std::string& output_dir);

}  // namespace surefoot
