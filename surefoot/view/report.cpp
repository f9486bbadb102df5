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

#include <utility>

namespace surefoot {
namespace {

// Numbers the figures as they come.
class Figures {
 public:
  std::string operator()(const std::string& image, std::string_view caption) {
    return report::figure(number_, image, caption);
  }

 private:
  int number_ = 0;
};

std::string motion(const RunData& run, Figures& figure) {
  std::string out = "<h2>Motion</h2>\n";
  out += figure(report::com_figure(run),
                "Tracking of the centre of mass, as the paper's Fig. 4: lateral and forward "
                "position against the plan, and the distance between the two in the plane.");
  out += figure(report::adaptation_figure(run), report::adaptation_caption(run));
  out +=
      figure(report::estimate_figure(run),
             "What the estimator believes of the base against the truth, until the robot stops for "
             "good. Position and heading count from the first tick: no sensor knows these, and "
             "nothing in control depends on them.");
  out += figure(report::map_figure(run), report::map_caption(run));
  out += figure(report::event_figure(run), "What the planner did, how often, and when.");
  return out;
}

std::string forces(const RunData& run, Figures& figure) {
  std::string out = "<h2>Forces</h2>\n";
  out += figure(report::torque_figure(run), "Commanded joint torques and their limits.");
  out += figure(
      report::force_figure(run),
      "Normal force of the ground on each foot: true (broad, coloured), and in the "
      "hierarchy's solution (thin line). Shaded: the leg stands. Short spikes where it swings "
      "are first touches, of probes too.");
  return out;
}

std::string hierarchy(const RunData& run, Figures& figure) {
  std::string out = "<h2>Hierarchy</h2>\n";
  out += figure(report::residual_figure(run), report::residual_caption(run));
  const std::string active = report::active_rows_figure(run);
  out +=
      figure(active,
             "Inequalities that acted for 10 ms or longer, with the number of their level, by task "
             "and leg. Friction and normal force are left out where a foot is lifted or set "
             "down: there they hold by themselves.");
  if (active.empty())
    out += "<p class=\"soft\">No inequality acted but where a foot was lifted or set down.</p>\n";
  out += report::blocker_table(run);
  return out + figure(report::timing_figure(run), report::timing_caption(run));
}

/// A page without its pictures, which stand between its two parts.
struct Page {
  std::string title, above, below;
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
          report::title(run.header) + report::verdict(run, outcome), std::move(below)};
}

void write(const std::string& path, const Page& page, const ReportPictures& pictures) {
  report::write_page(
      path, report::page(page.title, page.above + report::pictures(pictures) + page.below));
}

std::string path_in(const std::string& output_dir) { return output_dir + "/index.html"; }

}  // namespace

std::string write_report(const std::string& log_path, const std::string& output_dir,
                         const ReportPictures& pictures) {
  write(path_in(output_dir), read_page(log_path), pictures);
  return path_in(output_dir);
}

std::string write_report_before_pictures(
    const std::string& log_path, const std::string& output_dir,
    const std::function<ReportPictures(const std::string& page)>& make) {
  const Page page = read_page(log_path);
  const std::string path = path_in(output_dir);
  ReportPictures pictures;
  pictures.are_coming = true;
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
