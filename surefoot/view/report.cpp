#include "surefoot/view/report.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/view/captions.hpp"
#include "surefoot/view/outcome.hpp"
#include "surefoot/view/report_blockers.hpp"
#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/report_head.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "surefoot/view/report_page.hpp"
#include "surefoot/view/report_pictures.hpp"
#include "surefoot/view/run_data.hpp"

#include <filesystem>
#include <utility>
#include <vector>

namespace surefoot {
namespace {

constexpr const char* kFigureFolder = "figures";

// Numbers the figures as they come, and keeps them for files of their own.
class Figures {
 public:
  std::string operator()(const std::string& name, const std::string& image,
                         std::string_view caption) {
    images.emplace_back(name + ".svg", image);
    return report::figure(number_, kFigureFolder + ("/" + images.back().first), image, caption);
  }

  std::vector<std::pair<std::string, std::string>> images;  ///< by their files; empty: none

 private:
  int number_ = 0;
};

std::string motion(const RunData& run, Figures& figure) {
  std::string out = "<h2>Motion</h2>\n" + report::time_note(run);
  out += figure("com_tracking", report::com_figure(run), report::com_caption(run));
  out +=
      figure("terrain_adaptation", report::adaptation_figure(run), report::adaptation_caption(run));
  out += figure(
      "estimate", report::estimate_figure(run),
      "How far what the estimator believes of the base is off the truth, until the robot stops for "
      "good. Position and heading count from the first tick: no sensor knows these, and "
      "nothing in control depends on them.");
  out += figure("map", report::map_figure(run), report::map_caption(run));
  out += figure("events", report::event_figure(run),
                "What the planner did, by what it believed: how often, and when.");
  return out;
}

std::string forces(const RunData& run, Figures& figure) {
  std::string out = "<h2>Forces</h2>\n";
  out += figure("torques", report::torque_figure(run),
                "Commanded joint torques and their limits; what the drives apply is not drawn, but "
                "has a row in the table.");
  out += figure("forces", report::force_figure(run),
                "Normal force of the ground on each foot: true (broad, coloured), and in the "
                "hierarchy's solution (thin line). Shaded: by the plan the leg stands. Short "
                "spikes where it swings "
                "are first touches, of probes too.");
  return out;
}

std::string hierarchy(const RunData& run, Figures& figure) {
  std::string out = "<h2>Hierarchy</h2>\n";
  out += figure("residuals", report::residual_figure(run), report::residual_caption(run));
  const std::string active = report::active_rows_figure(run);
  out +=
      figure("active_limits", active,
             "Inequalities that acted for 10 ms or longer, with the number of their level, by task "
             "and leg. Friction and normal force are left out where a foot is lifted or set "
             "down: there they hold by themselves.");
  if (active.empty())
    out += "<p class=\"soft\">No inequality acted but where a foot was lifted or set down.</p>\n";
  out += report::blocker_table(run);
  return out + figure("tick_times", report::timing_figure(run), report::timing_caption(run));
}

/// A page without its pictures, which stand between its two parts, and the images of its figures.
struct Page {
  std::string title, above, below;
  std::vector<std::pair<std::string, std::string>> images;
};

Page read_page(const std::string& log_path) {
  const RunData run = read_run(log_path);
  const report::Outcome outcome = report::read_outcome(run.summary, run.header.options);
  Figures figure;
  std::string below =
      "<h2>Numbers</h2>\n" + report::numbers(outcome) + report::provenance(run, outcome);
  below += motion(run, figure);
  below += forces(run, figure);
  below += hierarchy(run, figure);
  return {run.header.scenario + " – surefoot",
          report::title(run.header) + report::verdict(run, outcome), std::move(below),
          std::move(figure.images)};
}

void write(const std::string& path, const Page& page, const ReportPictures& pictures) {
  report::write_text(
      path, report::page(page.title, page.above + report::pictures(pictures) + page.below));
}

std::string path_in(const std::string& output_dir) { return output_dir + "/index.html"; }

/// One that this run does not have may be there of an earlier one.
void write_figures(const std::string& output_dir, const Page& page) {
  for (const auto& [file, image] : page.images) {
    const std::string path = output_dir + "/" + kFigureFolder + "/" + file;
    std::error_code ignored;
    image.empty() ? void(std::filesystem::remove(path, ignored))
                  : report::write_text(path, report::svg_file(image));
  }
}

}  // namespace

std::string write_report(const std::string& log_path, const std::string& output_dir,
                         const ReportPictures& pictures) {
  const Page page = read_page(log_path);
  write_figures(output_dir, page);
  write(path_in(output_dir), page, pictures);
  return path_in(output_dir);
}

std::string write_report_before_pictures(
    const std::string& log_path, const std::string& output_dir,
    const std::function<ReportPictures(const std::string& page)>& make) {
  const Page page = read_page(log_path);
  const std::string path = path_in(output_dir);
  ReportPictures pictures;
  pictures.are_coming = true;
  write_figures(output_dir, page);
  write(path, page, pictures);
  pictures = make(path);
  try {
    write(path, page, pictures);
  } catch (const FileError& error) {
    pictures = {};
    pictures.why_none = error.what();
    write(path, page, pictures);
  }
  return path;
}

}  // namespace surefoot
