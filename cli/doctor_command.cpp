#include "cli/doctor_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/doctor/limit_guesses.hpp"
#include "surefoot/doctor/picture.hpp"
#include "surefoot/doctor/report.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

namespace surefoot::cli {
namespace {

/// Guesses stand in for what the robot file lacks.
std::vector<doctor::Trial> walk(const doctor::Diagnosis& robot, const std::string& out) {
  std::unique_ptr<Progress> progress;
  std::string shown;
  doctor::TrialOptions options;
  options.interrupted = runtime::interrupted;
  options.progress = [&](const std::string& scenario, double time, double duration) {
    if (scenario != shown) {
      progress.reset();
      progress = std::make_unique<Progress>(scenario, duration, "s");
      shown = scenario;
    }
    progress->update(time);
  };
  if (!out.empty()) options.logs = std::filesystem::path(out).replace_extension("").string() + "_";
  return doctor::try_walking(robot, options);
}

/// Without legs the picture and the findings say more than a file could.
void write_files(const doctor::Diagnosis& robot, const std::string& file) {
  if (has_legs(robot.anatomy)) {
    write_robot_file(robot, file);
    std::fprintf(stderr, "robot file: %s\n", file.c_str());
  } else {
    std::fprintf(stderr, "surefoot: no robot file: its legs were not found, see the errors\n");
  }
  std::fprintf(stderr, "picture: %s\n", write_picture(robot, file).c_str());
}

/// Beside the robot file.
void write_report(const doctor::Diagnosis& robot, const std::vector<doctor::Trial>& trials,
                  const std::string& file) {
  const std::string report = std::filesystem::path(file).replace_extension(".txt").string();
  logging::write_file(report, printable(report_text(robot, trials), "\n"));
  std::fprintf(stderr, "report: %s\n", report.c_str());
}

/// What to do next: a robot file with gaps is refused until they are filled in.
std::string next_step(const doctor::Diagnosis& robot, const std::string& file) {
  if (!robot.robot || !robot.robot_file.empty()) return "";
  if (file.empty()) return "\nwrite its robot file: --out " + robot.name + ".yaml\n";
  const std::string scenario = robot.robot->can_walk() ? "walk_flat" : "flat_feet";
  return "\n" + std::string(has_gaps(robot) ? "fill in " + file + ", then see it: " : "see it: ") +
         "surefoot run " + scenario + " --set robot=" + file + " --view\n";
}

}  // namespace

int doctor_command(const DoctorArguments& arguments) {
  runtime::watch_for_interrupt();
  const doctor::Diagnosis robot = doctor::examine(arguments.urdf, arguments.name);
  const bool can_walk = robot.robot.has_value();
  if (!arguments.out.empty()) write_files(robot, arguments.out);
  if (arguments.walk && !can_walk)
    std::fprintf(stderr, "surefoot: no trial: the program refuses the robot, see the errors\n");
  const std::vector<doctor::Trial> trials =
      arguments.walk && can_walk ? walk(robot, arguments.out) : std::vector<doctor::Trial>();
  if (arguments.walk && !arguments.out.empty()) write_report(robot, trials, arguments.out);
  std::cout << printable(arguments.json
                             ? report_json(robot, trials) + "\n"
                             : report_text(robot, trials) + next_step(robot, arguments.out),
                         "\n")
            << std::flush;
  if (has_error(robot.findings)) return kWrongInput;
  return std::ranges::all_of(trials, &doctor::Trial::succeeded) ? kPassed : kFailed;
}

}  // namespace surefoot::cli
