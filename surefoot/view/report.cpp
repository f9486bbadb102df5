#include "surefoot/view/report.hpp"

#include "surefoot/view/report_figures.hpp"
#include "surefoot/view/report_numbers.hpp"
#include "surefoot/view/report_page.hpp"
#include "surefoot/view/run_data.hpp"
#include "surefoot/view/svg.hpp"

namespace surefoot {
namespace {

std::string head(const RunData& run) {
  const LogHeader& header = run.header;
  std::string out = "<h1>" + plot::escape(header.scenario) + "</h1>\n<p class=\"facts\">" +
                    plot::escape(header.robot.name) + " · stack " + plot::escape(header.stack) +
                    " · estimation " + plot::escape(header.estimation) + " · seed " +
                    std::to_string(header.seed) + " · surefoot " + plot::escape(header.version) +
                    "</p>\n";
  if (!run.problem.empty()) {
    out += "<p class=\"warning\">The log is not whole, so this shows only its beginning. " +
           plot::escape(run.problem) + ".</p>\n";
  }
  out += report::verdict(run.summary);
  for (const std::string& note : header.notes)
    out += "<p class=\"soft\">" + plot::escape(note) + "</p>\n";
  return out;
}

std::string figures(const RunData& run) {
  int number = 0;
  const auto figure = [&number](const std::string& image, const char* caption) {
    return report::figure(number, image, caption);
  };
  std::string out = "<h2>Motion</h2>\n";
  out +=
      figure(report::com_figure(run),
             "Tracking of the centre of mass, as the paper's Fig. 4: lateral and forward position "
             "against the plan, and the distance between the two in the plane.");
  out += figure(
      report::adaptation_figure(run),
      "Adaptation to the terrain, as the paper's Fig. 6. (a), (b) Errors of the torso against "
      "its reference, in the control frame; orange: the limb limits act. Below, the distance of "
      "each hip from its foot, with the limits; grey: the leg stands, orange: it searches for "
      "ground, white: it swings.");
  out += figure(report::event_figure(run), "What the planner did, and when.");
  out +=
      figure(report::footprint_figure(run),
             "Seen from above: footprints in the leg's colour (front feet large, hind feet small), "
             "the path of the centre of mass, and the triangles of three feet that carry the robot "
             "while the fourth swings.");
  out += "<h2>Forces</h2>\n";
  out += figure(report::torque_figure(run), "Commanded joint torques and their limits.");
  out += figure(
      report::force_figure(run),
      "Normal force of the ground on each foot, true (coloured) and in the hierarchy's solution "
      "(grey line). Shaded: the leg stands.");
  out += "<h2>Hierarchy</h2>\n";
  out += figure(
      report::residual_figure(run),
      "Residual of each level over time, the largest in each column, in the unit of the level's "
      "rows. A level whose colour moves towards red is kept from its goal by those above it. The "
      "last one, which asks for no contact force at all, never reaches it.");
  out += figure(
      report::active_rows_figure(run),
      "Inequality rows at a bound or beyond it, with the number of their level; at most the 24 "
      "that were active longest.");
  out += figure(report::timing_figure(run),
                "Wall-clock time of the controller's ticks, on a logarithmic axis. At 400 Hz there "
                "are 2500 µs for one.");
  return out;
}

}  // namespace

std::string write_report(const std::string& log_path, const std::string& output_dir) {
  const RunData run = read_run(log_path);
  const std::string path = output_dir + "/index.html";
  report::write_page(
      path, report::page(run.header.scenario + " – surefoot",
                         head(run) + "<h2>Numbers</h2>\n" +
                             report::numbers(run.summary, run.header.options) + figures(run)));
  return path;
}

}  // namespace surefoot
