#include "surefoot/closed_loop/run_log.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/closed_loop/log_terrain.hpp"
#include "surefoot/config/stack_text.hpp"
#include "surefoot/logging/visible_residual.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/urdf.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <algorithm>

namespace surefoot::closed_loop {
namespace {

/// `stack`: with its defaults.
logging::LogLimbLimits limb_limits(const control::StackOptions& stack) {
  for (std::size_t level = 0; level < stack.levels.size(); ++level) {
    for (const control::TaskSpec& task : stack.levels[level].tasks) {
      if (task.task != "limb_extension_limits") continue;
      return {.level = static_cast<int>(level),
              .form = task.choices.at("form") == "radial" ? "radial" : "vertical",
              .min = task.numbers.at("min"),
              .max = task.numbers.at("max")};
    }
  }
  return {};
}

logging::LogRobot robot_of(const model::RobotModel& model) {
  const model::RobotDescription& description = model.description();
  logging::LogRobot robot;
  robot.name = description.name;
  robot.num_legs = description.num_legs();
  robot.joint_names = description.joint_names();
  robot.torque_limit = description.torque_limit;
  robot.mass = model.mass();
  robot.foot_radius = description.legs[0].foot_radius;
  robot.frame_names = model::Frames(description).names();
  return robot;
}

std::vector<std::string> event_names() {
  std::vector<std::string> names;
  for (int event = 0;; ++event) {
    names.emplace_back(name(static_cast<PlanEvent>(event)));
    if (names.back() == "unknown") break;
  }
  names.pop_back();
  return names;
}

/// Quoted if a shell would not take it for one word.
std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char letter : text) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  return quoted + "'";
}

std::vector<logging::LogAttachment> attachments(const config::Scenario& scenario,
                                                const control::StackOptions& stack,
                                                const simulation::Plant* plant) {
  std::vector<logging::LogAttachment> files{
      {"robot.urdf", "application/xml", model::urdf_text(scenario.robot)},
      {"resolved_stack.yaml", "application/yaml", config::stack_yaml(stack)}};
  if (plant != nullptr)
    files.insert(files.begin(), {"model.xml", "application/xml", plant->model_xml()});
  for (const config::SourceFile& source : scenario.sources) {
    files.push_back({source.name, "application/yaml", source.text});
  }
  return files;
}

}  // namespace

std::string run_again(const config::Scenario& scenario) {
  std::string command = "surefoot run " + shell_word(scenario.requested);
  if (scenario.seed != 0) command += " --seed " + std::to_string(scenario.seed);
  for (const std::string& assignment : scenario.assignments) {
    command += " --set " + shell_word(assignment);
  }
  return command;
}

logging::RowNamer row_namer(std::vector<std::vector<std::string>> names) {
  return [names = std::move(names)](int level, std::int32_t id) -> std::string {
    const auto k = static_cast<std::size_t>(level), i = static_cast<std::size_t>(id);
    return level >= 0 && k < names.size() && id >= 0 && i < names[k].size() ? names[k][i] : "?";
  };
}

logging::LogHeader log_header(const config::Scenario& scenario,
                              const control::Controller& controller, const simulation::Plant* plant,
                              const model::RobotModel& model) {
  const control::StackOptions stack = config::with_defaults(scenario.controller.stack);
  logging::LogHeader header;
  header.version = build_info().version;
  header.commit = build_info().commit;
  header.command = run_again(scenario);
  header.scenario = scenario.name;
  header.description = scenario.description;
  header.stack = stack.name;
  header.estimation = name(scenario.estimation);
  header.options = scenario.options_json;
  header.seed = scenario.seed;
  for (const config::RandomDraw& draw : scenario.drawn)
    header.drawn.push_back({draw.path, draw.value});
  header.control_period = scenario.controller.period;
  header.level_names = controller.level_names();
  header.level_units = controller.level_units();
  for (std::size_t k = 0; k < header.level_names.size(); ++k)
    header.level_visible.push_back(logging::visible_residual(
        header.level_names[k], header.level_units[k], model.description().scale));
  header.event_names = event_names();
  header.own_parts = controller.own_parts();
  header.robot = robot_of(model);
  header.limb = limb_limits(stack);
  if (plant != nullptr) header.terrain = log_terrain(scenario.plant.terrain);
  header.notes = run_notes(scenario, controller, plant);
  header.attachments = attachments(scenario, stack, plant);
  header.row_name = row_namer(controller.row_names());
  return header;
}

std::vector<std::string> run_notes(const config::Scenario& scenario,
                                   const control::Controller& controller,
                                   const simulation::Plant* plant) {
  std::vector<std::string> notes = scenario.notes;
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& note : more) {
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
    }
  };
  add(controller.notes());
  if (plant != nullptr) add(plant->notes());
  return notes;
}

}  // namespace surefoot::closed_loop
