#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/robot_file_text.hpp"
#include "surefoot/logging/scratch_folder.hpp"

namespace surefoot::doctor {
namespace {

/// check_inertias and check_feet tell these.
bool is_told_already(const std::string& note) {
  return note.find("inertia") != std::string::npos ||
         note.find("foot sphere was added") != std::string::npos;
}

}  // namespace

void check_stance(Diagnosis& robot) {
  if (!robot.robot) return;
  const logging::ScratchFolder scratch;
  const std::string file =
      scratch.write("robot.yaml", robot_file_text(robot, scratch.path(), Guesses::as_numbers));
  try {
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = "walk_flat", .seed = 0, .assignments = {"robot=" + file}});
    for (const std::string& note : closed_loop::check_setup(scenario)) {
      if (is_told_already(note)) continue;
      robot.findings.push_back({Severity::note, Confidence::certain, "walk_flat", 0, note, ""});
    }
  } catch (const Error& error) {
    robot.findings.push_back({Severity::error, Confidence::certain, "walk_flat", 0,
                              std::string("the robot can't be stood up: ") + error.what(),
                              "correct what is named; `surefoot run walk_flat --check --set "
                              "robot=FILE` checks it again"});
  }
}

}  // namespace surefoot::doctor
