#include "surefoot/config/scaling.hpp"

#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/joint_fitting.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace surefoot::config {
namespace {

/// Scales a number for a robot of scale 1 to this robot: factor × number + offset.
struct Rule {
  double factor = 1.0, offset = 0.0;

  [[nodiscard]] double of(double number) const { return factor * number + offset; }
};

Rule rule_of(Sizing sizing, std::string_view unit, const Scale& scale) {
  switch (sizing) {
    case Sizing::none:
      return {};
    case Sizing::half_length:
      return {.factor = scale.half_length};
    case Sizing::half_width:
      return {.factor = scale.half_width};
    case Sizing::base_height:
      return {.factor = scale.length, .offset = -scale.hip_height};
    case Sizing::stride:
      return {.factor = scale.speed() * scale.stride};
    case Sizing::walk:
      return {.factor = scale.time() / scale.stride};
    case Sizing::by_unit:
      break;
  }
  return {.factor = scale.of(unit)};
}
/// Of a Field or a TaskParameter.
template <typename Option>
Rule rule_of(const Option& option, const Scale& scale) {
  return rule_of(option.sizing, option.unit, scale);
}

/// Scales all numbers at and below a node; other text stays.
void apply(const Rule& rule, ConfigNode& node) {
  for (ConfigNode& item : node.items) apply(rule, item);
  for (auto& [key, member] : node.members) apply(rule, member);
  const std::optional<double> number = number_in(node.text);
  if (node.kind != ConfigNode::Kind::scalar || !number) return;
  node.text = shortest_text(rule.of(*number));
}

/// Of the library's tasks: numbers of the user's own are as they stand.
const tasks::TaskParameter* find_parameter(const std::string& task, const std::string& name) {
  for (const tasks::TaskInfo& info : tasks::task_catalog()) {
    const auto found = std::ranges::find(info.parameters, name, &tasks::TaskParameter::name);
    if (info.name == task && found != info.parameters.end()) return &*found;
  }
  return nullptr;
}

void scale_tasks(ConfigNode& tasks, const Scale& scale) {
  for (auto& [task, parameters] : tasks.members) {
    for (auto& [name, value] : parameters.members) {
      const tasks::TaskParameter* parameter = find_parameter(task, name);
      if (parameter != nullptr) apply(rule_of(*parameter, scale), value);
    }
  }
}

Sizing sizing_of_metric(std::string_view metric) {
  if (metric == "speed_mps") return Sizing::stride;
  if (metric == "duration_s") return Sizing::walk;
  return metric == "base_height_end_m" ? Sizing::base_height : Sizing::by_unit;
}

/// A metric's name ends in its unit.
void scale_criteria(ConfigNode& criteria, const Scale& scale) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kUnits{
      {{"_m", "m"}, {"_s", "s"}, {"_mps", "m/s"}, {"_nm", "N·m"}}};
  for (auto& [metric, limits] : criteria.members) {
    for (const auto& [suffix, unit] : kUnits) {
      if (metric.ends_with(suffix)) apply(rule_of(sizing_of_metric(metric), unit, scale), limits);
    }
  }
}

/// Scales the option at a path. False: there is no option with numbers.
bool scale_numbers(const std::string& path, ConfigNode& node, const Scale& scale) {
  bool is_number = false;
  (void)visit_scenario_option(
      path,
      [&](const Field& field) {
        is_number = std::holds_alternative<double*>(field.value) ||
                    std::holds_alternative<Numbers>(field.value) ||
                    std::holds_alternative<std::vector<double>*>(field.value);
        if (is_number) apply(rule_of(field, scale), node);
      },
      kMaxLegs);
  return is_number;
}

/// Scales the option at a path, or an element of an option; else everything below the path.
void scale_option(const std::string& path, ConfigNode& node, const Scale& scale) {
  if (scale_numbers(path, node, scale)) return;
  if (node.kind != ConfigNode::Kind::map &&
      scale_numbers(path.substr(0, path.rfind('.')), node, scale))
    return;
  for (auto& [key, member] : node.members) scale_option(path + "." + key, member, scale);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    scale_option(path + "." + std::to_string(i), node.items[i], scale);
}

void scale_defaults(Group& group, const Scale& scale) {
  for (Field& field : group.fields) {
    const Rule rule = rule_of(field, scale);
    if (auto* below = std::get_if<Group>(&field.value)) scale_defaults(*below, scale);
    if (auto* entries = std::get_if<Entries>(&field.value)) {
      for (Entries::Shape& shape : entries->shapes) {
        shape.add = [add = shape.add, scale] {
          Group entry = add();
          scale_defaults(entry, scale);
          return entry;
        };
      }
    }
    if (const auto* value = std::get_if<double*>(&field.value)) **value = rule.of(**value);
    if (const auto* numbers = std::get_if<Numbers>(&field.value)) {
      for (std::size_t i = 0; i < numbers->names.size(); ++i)
        numbers->data[i] = rule.of(numbers->data[i]);
    }
  }
}

}  // namespace

bool take_scaled(ConfigNode& file) {
  bool is_scaled = false;
  if (const ConfigNode* node = file.find(kScaled)) {
    if (node->text != "true" && node->text != "false")
      fail_at(*node, kScaled, "must be true or false");
    is_scaled = node->text == "true";
  }
  std::erase_if(file.members, [](const auto& member) { return member.first == kScaled; });
  return is_scaled;
}

void scale_ranges(ConfigNode& ranges, const Scale& scale) {
  for (auto& [path, range] : ranges.members) {
    constexpr std::string_view kTasks = "tasks.";
    const std::size_t dot = path.rfind('.');
    const tasks::TaskParameter* parameter =
        path.starts_with(kTasks) && dot > kTasks.size()
            ? find_parameter(path.substr(kTasks.size(), dot - kTasks.size()), path.substr(dot + 1))
            : nullptr;
    if (parameter != nullptr) {
      apply(rule_of(*parameter, scale), range);
    } else {
      scale_option(path, range, scale);
    }
  }
}

/// An order of four legs says nothing of six: they take their usual one.
void fit_order(ConfigNode& tree, const model::RobotDescription& robot) {
  if (robot.num_legs() == kNumLegs) return;
  ConfigNode* planner = tree.find("planner");
  ConfigNode* gait = planner == nullptr ? nullptr : planner->find("gait");
  if (gait != nullptr)
    std::erase_if(gait->members, [](const auto& member) { return member.first == "order"; });
}

void fit_scenario(ConfigNode& tree, const model::RobotDescription& robot) {
  const Scale& scale = robot.scale;
  fit_joints(tree, robot);
  fit_order(tree, robot);
  for (auto& [key, node] : tree.members) {
    if (key == "tasks") {
      scale_tasks(node, scale);
    } else if (key == "criteria") {
      scale_criteria(node, scale);
    } else if (key == "randomise") {
      scale_ranges(node, scale);
    } else {
      scale_option(key, node, scale);
    }
  }
}

void fit_defaults(Group& options, const model::RobotDescription& robot, Scenario& scenario) {
  scale_defaults(options, robot.scale);
  gaits::KneeConfiguration& knees = scenario.controller.planner.stance.knees;
  knees = knees_that_fit(robot, knees);
  scenario.plant.actuators.stall_torque = robot.stall_torque;
  scenario.plant.actuators.no_load_speed = robot.no_load_speed;
}

double default_of(const tasks::TaskParameter& parameter, const Scale& scale) {
  return rule_of(parameter, scale).of(parameter.default_value);
}

void scale_weights(control::LevelSpec& level, const Scale& scale, const tasks::OwnTasks& own) {
  for (control::TaskSpec& task : level.tasks) {
    const std::string_view unit = tasks::task_info(task.task, own).unit;
    task.weight /= scale.of(unit.substr(0, unit.find(' ')));
  }
}

void scale_level(control::LevelSpec& level, const Scale& scale, const tasks::OwnTasks& own,
                 bool only_defaults) {
  if (!only_defaults && level.tasks.size() > 1) scale_weights(level, scale, own);
  for (control::TaskSpec& task : level.tasks) {
    for (const tasks::TaskParameter& parameter : tasks::task_info(task.task, own).parameters) {
      const std::string name(parameter.name);
      const auto given = task.numbers.find(name);
      if (given == task.numbers.end()) {
        const double value = default_of(parameter, scale);
        if (value != parameter.default_value) task.numbers[name] = value;
      } else if (!only_defaults) {
        given->second = rule_of(parameter, scale).of(given->second);
      }
    }
  }
}

}  // namespace surefoot::config
