#include "surefoot/base/error.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/doctor/checks.hpp"
#include "surefoot/doctor/guessed_file.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace surefoot::doctor {
namespace {

/// check_inertias, check_feet and check_limits tell these.
bool is_told_already(const std::string& note) {
  return std::ranges::any_of(
      std::array{"inertia", "foot sphere was added", "a placeholder?"},
      [&](const char* words) { return note.find(words) != std::string::npos; });
}

/// Where a scenario stands otherwise than it asks; empty: nowhere.
std::string other_knees(const Diagnosis& robot, const char* scenario, std::string_view asked) {
  const auto named = [&](std::string_view name) {
    return std::ranges::find(config::kKnees, name, [](const auto& one) { return one.first; });
  };
  const auto fitting = config::knees_that_fit(*robot.robot, named(asked)->second);
  const auto chosen =
      std::ranges::find(config::kKnees, fitting, [](const auto& one) { return one.second; });
  if (chosen->first == asked) return "";
  return std::string(scenario) + " stands with knees " + std::string(chosen->first) + ", not " +
         std::string(asked);
}

}  // namespace

void check_stance(Diagnosis& robot) {
  if (!robot.robot) return;
  const bool walks = robot.robot->can_walk();
  const std::string walk = walks ? other_knees(robot, "walk_flat", "x") : "",
                    down = walks ? other_knees(robot, "step_down", "forward") : "";
  const std::string scenario_name = walks ? "walk_flat" : "flat_feet";
  if (!walk.empty() || !down.empty()) {
    robot.findings.push_back(
        {Severity::note, Confidence::certain, "stance", 0,
         "by the limits of KFE " + walk + (walk.empty() || down.empty() ? "" : ", and ") + down,
         ""});
  }
  const GuessedFile file(robot);
  try {
    const config::Scenario scenario = config::load_scenario(
        {.name_or_path = scenario_name, .seed = 0, .assignments = {"robot=" + file.path()}});
    for (const std::string& note : closed_loop::check_setup(scenario)) {
      if (is_told_already(note)) continue;
      robot.findings.push_back({Severity::note, Confidence::certain, scenario_name, 0, note, ""});
    }
  } catch (const Error& error) {
    const std::string_view what = error.what();
    if (has_error(robot.findings) && what.find("it can't stand: ") != std::string_view::npos)
      return;
    robot.findings.push_back(
        {Severity::error, Confidence::certain, scenario_name, 0,
         std::string("the robot can't be stood up: ") + file.without_path(error.what()),
         "correct what is named; `surefoot run " + scenario_name +
             " --check --set robot=FILE` checks it again"});
  }
}

}  // namespace surefoot::doctor
