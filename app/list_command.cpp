#include "app/list_command.hpp"

#include "app/exit_code.hpp"
#include "app/results_table.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/config/config_json.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <iostream>

namespace surefoot {
namespace {

using Table = std::vector<std::vector<std::string>>;

std::string number(double value) { return formatted("%g", value); }

Table robots() {
  Table table;
  for (const std::string& name : list_data("robots")) {
    table.push_back({name, load_robot(name).urdf_path});
  }
  return table;
}

std::string levels_of(const StackOptions& stack) {
  std::string levels;
  for (const LevelSpec& level : stack.levels) levels += (levels.empty() ? "" : " > ") + level.name;
  return levels;
}

Table stacks() {
  Table table;
  for (const std::string& name : list_data("stacks")) {
    table.push_back({name, describe_data("stacks", name)});
    table.push_back({"", levels_of(load_stack(name))});
  }
  return table;
}

Table scenarios() {
  Table table;
  for (const std::string& name : list_data("scenarios")) {
    table.push_back({name, describe_data("scenarios", name)});
  }
  return table;
}

Table tasks() {
  Table table;
  for (const TaskInfo& task : task_catalog()) {
    table.push_back(
        {std::string(task.name), std::string(task.equation), std::string(task.summary)});
    for (const TaskParameter& parameter : task.parameters) {
      table.push_back({"  " + std::string(parameter.name), number(parameter.default_value),
                       std::string(parameter.unit) + "  " + std::string(parameter.help)});
    }
    for (const TaskChoice& choice : task.choices) {
      std::string values;
      for (const std::string_view value : choice.values)
        values += (values.empty() ? "" : " | ") + std::string(value);
      table.push_back({"  " + std::string(choice.name), std::string(choice.default_value),
                       values + "  " + std::string(choice.help)});
    }
  }
  return table;
}

/// Each with the files that it includes and its ranges.
Table randomisations() {
  constexpr const char* kFolder = "randomisations";
  Table table;
  for (const std::string& name : list_data(kFolder)) {
    table.push_back({name});
    for (const auto& [path, range] : parse_yaml_file(find_data_file(kFolder, name)).members) {
      table.push_back({"  " + path, to_json(range)});
    }
  }
  return table;
}

}  // namespace

const std::vector<std::string>& listable() {
  static const std::vector<std::string> kListable{"robots", "stacks", "scenarios", "randomisations",
                                                  "tasks"};
  return kListable;
}

int list_command(const std::string& what) {
  Table table;
  if (what == "robots") table = robots();
  if (what == "stacks") table = stacks();
  if (what == "scenarios") table = scenarios();
  if (what == "randomisations") table = randomisations();
  if (what == "tasks") table = tasks();
  std::cout << printable(aligned(table), "\n");
  return kPassed;
}

}  // namespace surefoot
