#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/guessed_file.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

/// check_inertias and check_feet tell these.
bool is_told_already(const std::string& note) {
  return note.find("inertia") != std::string::npos ||
         note.find("foot sphere was added") != std::string::npos;
}

void tell_other_knees(Diagnosis& robot, const char* scenario, std::string_view asked) {
  const auto named = [&](std::string_view name) {
    return std::ranges::find(config::kKnees, name, [](const auto& one) { return one.first; });
  };
  const auto fitting = config::knees_that_fit(*robot.robot, named(asked)->second);
  const auto chosen =
      std::ranges::find(config::kKnees, fitting, [](const auto& one) { return one.second; });
  if (chosen->first == asked) return;
  robot.findings.push_back({Severity::note, Confidence::certain, scenario, 0,
                            "it stands with knees " + std::string(chosen->first) + ", not " +
                                std::string(asked) + ", which the limits of KFE rule out",
                            ""});
}

}  // namespace

void check_stance(Diagnosis& robot) {
  if (!robot.robot) return;
  tell_other_knees(robot, "walk_flat", "x");
  tell_other_knees(robot, "step_down", "forward");
  const GuessedFile file(robot);
  try {
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = "walk_flat", .seed = 0, .assignments = {"robot=" + file.path()}});
    for (const std::string& note : closed_loop::check_setup(scenario)) {
      if (is_told_already(note)) continue;
      robot.findings.push_back({Severity::note, Confidence::certain, "walk_flat", 0, note, ""});
    }
  } catch (const Error& error) {
    robot.findings.push_back(
        {Severity::error, Confidence::certain, "walk_flat", 0,
         std::string("the robot can't be stood up: ") + file.without_path(error.what()),
         "correct what is named; `surefoot run walk_flat --check --set "
         "robot=FILE` checks it again"});
  }
}

}  // namespace surefoot::doctor
