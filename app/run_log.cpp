#include "app/run_log.hpp"

#include "surefoot/base/build_info.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>

namespace surefoot {
namespace {

/// A task's number as the stack has it, or its default.
double parameter(const TaskSpec& task, const std::string& name) {
  const auto given = task.numbers.find(name);
  if (given != task.numbers.end()) return given->second;
  for (const TaskParameter& known : task_info(task.task).parameters) {
    if (known.name == name) return known.default_value;
  }
  return kNaN;
}

std::string choice(const TaskSpec& task, const std::string& name) {
  const auto given = task.choices.find(name);
  if (given != task.choices.end()) return given->second;
  for (const TaskChoice& known : task_info(task.task).choices) {
    if (known.name == name) return std::string(known.default_value);
  }
  return "";
}

LogLimbLimits limb_limits(const StackOptions& stack) {
  for (const LevelSpec& level : stack.levels) {
    for (const TaskSpec& task : level.tasks) {
      if (task.task != "limb_extension_limits") continue;
      return {.form = choice(task, "form") == "radial" ? "radial" : "vertical",
              .min = parameter(task, "min"),
              .max = parameter(task, "max")};
    }
  }
  return {};
}

LogRobot robot_of(const RobotModel& model) {
  const RobotDescription& description = model.description();
  LogRobot robot;
  robot.name = description.name;
  for (const Leg leg : kLegs) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      robot.joint_names[kJointsPerLeg * index(leg) + j] = description.legs[index(leg)].joints[j];
    }
  }
  robot.torque_limit = description.torque_limit;
  robot.mass = model.mass();
  robot.max_leg_length = description.max_leg_length;
  robot.foot_radius = description.foot_radius;
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

std::vector<LogAttachment> attachments(const Scenario& scenario, const Plant& plant) {
  std::vector<LogAttachment> files{{"model.xml", "application/xml", plant.model_xml()}};
  for (const SourceFile& source : scenario.sources) {
    files.push_back({source.name, "application/yaml", source.text});
  }
  return files;
}

}  // namespace

LogHeader log_header(const Scenario& scenario, const Controller& controller, const Plant& plant,
                     const RobotModel& model) {
  LogHeader header;
  header.version = build_info().version;
  header.scenario = scenario.name;
  header.stack = scenario.controller.stack.name;
  header.estimation = "truth";
  header.options = scenario.options_json;
  header.seed = scenario.seed;
  header.control_period = scenario.controller.period;
  header.level_names = controller.level_names();
  header.event_names = event_names();
  header.robot = robot_of(model);
  header.limb = limb_limits(scenario.controller.stack);
  header.notes = run_notes(controller, plant);
  header.attachments = attachments(scenario, plant);
  header.row_name = [&controller](int level, std::int32_t id) {
    return controller.row_name(level, id);
  };
  return header;
}

std::vector<std::string> run_notes(const Controller& controller, const Plant& plant) {
  std::vector<std::string> notes = controller.notes();
  for (const std::string& note : plant.notes()) {
    if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  }
  return notes;
}

}  // namespace surefoot
