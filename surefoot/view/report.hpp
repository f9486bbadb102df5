#pragma once

#include <functional>
#include <string>
#include <vector>

namespace surefoot {

/// Pictures of a run for its report, made elsewhere: the folder knows of no renderer.
struct ReportPictures {
  std::string strip{};               ///< JPEG: a sequence of moments; empty: none
  std::vector<double> times{};       ///< of these moments [s]
  std::string clip{};                ///< MP4, H.264; empty: none
  double first = 0.0, last = 0.0;    ///< of the run, that the clip shows [s]
  bool has_pushes = false;           ///< something pushes the robot in the strip
  std::vector<std::string> notes{};  ///< what they don't show as it is
  std::string why_none{};            ///< in words; empty where there are pictures
  bool are_coming = false;           ///< they are being made
};

/// Writes OUTPUT_DIR/index.html from a log alone: one page without scripts or network, with the
/// run's numbers beside those of the paper and figures after the paper's Fig. 4 and Fig. 6,
/// footprints, torques, level residuals and times; and with pictures, where it is given some,
/// inside the page. Each figure is an SVG file, too, in OUTPUT_DIR/figures. The folder is made once
/// the log was read. A log that was cut off is shown as far as it goes, and the page says so.
/// Returns the page's path.
///
/// Throws FileError if the log can't be read or the page can't be written.
std::string write_report(const std::string& log_path, const std::string& output_dir,
                         const ReportPictures& pictures = {});

/// The same in two steps, as pictures take a while: the page is there before they are made, which
/// it says, and again with them. `make` gets its path. A page that finds no room for them stays
/// without, and says why.
std::string write_report_before_pictures(
    const std::string& log_path, const std::string& output_dir,
    const std::function<ReportPictures(const std::string& page)>& make);

}  // namespace surefoot
