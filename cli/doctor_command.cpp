#include "cli/doctor_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/picture.hpp"
#include "surefoot/doctor/report.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

namespace surefoot::cli {
namespace {

/// The file to examine: a robot that ships is known by its name.
std::string file_of(const std::string& given) {
  const std::vector<std::string> ours = config::list_data("robots");
  const bool is_name = !std::filesystem::exists(given) && std::ranges::count(ours, given) > 0;
  return is_name ? config::load_robot(given).urdf_path : given;
}

/// Guesses stand in for what the robot file lacks.
std::vector<doctor::Trial> walk(const doctor::Diagnosis& robot) {
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

/// What to do next: a robot file with gaps is refused until they are filled in.
std::string next_step(const doctor::Diagnosis& robot, const std::string& file) {
  if (!robot.robot) return "";
  if (file.empty()) return "\nwrite its robot file: --out " + robot.name + ".yaml\n";
  const std::string scenario = robot.robot->can_walk() ? "walk_flat" : "flat_feet";
  return "\n" + std::string(has_gaps(robot) ? "fill in " + file + ", then see it: " : "see it: ") +
         "surefoot run " + scenario + " --set robot=" + file + " --view\n";
}

}  // namespace

int doctor_command(const DoctorArguments& arguments) {
  runtime::watch_for_interrupt();
  const doctor::Diagnosis robot = doctor::examine(file_of(arguments.urdf), arguments.name);
  const bool can_walk = robot.robot.has_value();
  if (!arguments.out.empty()) write_files(robot, arguments.out);
  if (arguments.walk && !can_walk)
    std::fprintf(stderr, "surefoot: no trial: the program refuses the robot, see the errors\n");
  const std::vector<doctor::Trial> trials =
      arguments.walk && can_walk ? walk(robot) : std::vector<doctor::Trial>();
  std::cout << printable(arguments.json
                             ? report_json(robot, trials) + "\n"
                             : report_text(robot, trials) + next_step(robot, arguments.out),
                         "\n")
            << std::flush;
  if (has_error(robot.findings)) return kWrongInput;
  return std::ranges::all_of(trials, &doctor::Trial::succeeded) ? kPassed : kFailed;
}

}  // namespace surefoot::cli
