#include "surefoot/view/report.hpp"

#include "surefoot/view/captions.hpp"
#include "surefoot/view/outcome.hpp"
#include "surefoot/view/report_blockers.hpp"
#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/report_head.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "surefoot/view/report_page.hpp"
#include "surefoot/view/report_pictures.hpp"
#include "surefoot/view/run_data.hpp"

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

std::string body(const RunData& run, const ReportPictures& pictures) {
  const report::Outcome outcome = report::read_outcome(run.summary, run.header.options);
  Figures figure;
  std::string out = report::title(run.header) + report::verdict(run, outcome);
  out += report::pictures(pictures);
  out += "<h2>Numbers</h2>\n" + report::numbers(outcome) + report::provenance(run, outcome);
  out += motion(run, figure);
  out += forces(run, figure);
  out += hierarchy(run, figure);
  return out;
}

}  // namespace

std::string write_report(const std::string& log_path, const std::string& output_dir,
                         const ReportPictures& pictures) {
  const RunData run = read_run(log_path);
  const std::string path = output_dir + "/index.html";
  report::write_page(path, report::page(run.header.scenario + " – surefoot", body(run, pictures)));
  return path;
}

}  // namespace surefoot
