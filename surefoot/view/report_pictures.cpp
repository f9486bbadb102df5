#include "surefoot/view/report_pictures.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/view/svg.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace surefoot::report {
namespace {

/// As the pictures themselves have it.
std::string seconds(double time) { return formatted("%.2f s", time); }

std::string times_of(const ReportPictures& pictures) {
  std::string out;
  for (const double time : pictures.times) out += (out.empty() ? "" : ", ") + seconds(time);
  return out;
}

std::string strip(const ReportPictures& pictures) {
  if (pictures.strip.empty()) return "";
  return "<figure class=\"pictures\">\n<img alt=\"The robot at " + times_of(pictures) +
         "\" src=\"data:image/jpeg;base64," + base64(pictures.strip) +
         "\">\n<figcaption>The robot in the simulation, after the paper's Fig. 5, at " +
         times_of(pictures) +
         ". Arrows: ground forces, grey below 60 % of their friction cone, amber from there and "
         "red from 90 % on" +
         (pictures.has_pushes ? "; the yellow arrow, 0.2 m longer than its force alone would make "
                                "it: what pushes the robot from outside"
                              : "") +
         ". Dark green: "
         "the region between the feet that carry, at the height of the highest; black: the centre "
         "of mass over it. Legs in grey carry, in white are in the air, in amber search for "
         "ground.</figcaption>\n</figure>\n";
}

std::string clip(const ReportPictures& pictures) {
  if (pictures.clip.empty()) return "";
  return "<figure class=\"pictures\">\n<video controls loop muted playsinline "
         "src=\"data:video/mp4;base64," +
         base64(pictures.clip) + "\"></video>\n<figcaption>" + seconds(pictures.first) + " to " +
         seconds(pictures.last) + " of the run, at its own speed.</figcaption>\n</figure>\n";
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_there = i + k < bytes.size();
      group = group << 8 | (is_there ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    const std::size_t digits = std::min<std::size_t>(bytes.size() - i, 3) + 1;
    for (std::size_t k = 0; k < 4; ++k)
      out += k < digits ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

std::string pictures(const ReportPictures& pictures) {
  std::string out = strip(pictures) + clip(pictures);
  if (pictures.are_coming)
    out +=
        "<p class=\"soft\">They are being made: load this page again in a while. If this stays so, "
        "<code>surefoot report</code> makes them of the log.</p>\n";
  if (!pictures.why_none.empty())
    out += "<p class=\"soft\">No pictures: " + plot::escape(pictures.why_none) + "</p>\n";
  for (const std::string& note : pictures.notes)
    out += "<p class=\"soft\">" + plot::escape(note) + "</p>\n";
  return out.empty() ? "" : "<h2>Pictures</h2>\n" + out;
}

}  // namespace surefoot::report
