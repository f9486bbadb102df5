#include "cli/list_command.hpp"

#include "cli/exit_code.hpp"
#include "cli/metric_list.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/config/config_json.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/description_file.hpp"
#include "surefoot/config/json_schema.hpp"
#include "surefoot/config/option_list.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/logging/json_text.hpp"
#include "surefoot/model/proportions.hpp"
#include "surefoot/model/robot_model.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <iostream>

namespace surefoot::cli {
namespace {

using Table = std::vector<std::vector<std::string>>;

std::string number(double value) { return formatted("%g", value); }

/// What a robot is and its URDF, or why there is none: descriptions come with other packages.
std::vector<std::string> described_robot(const std::string& name) {
  try {
    const model::RobotDescription robot = config::load_robot(name);
    model::RobotModel model(robot);
    return {name, std::to_string(robot.num_legs()) + " legs",
            std::to_string(robot.num_joints()) + " joints",
            formatted("%.3g kg", model::proportions_of(model).mass), robot.urdf_path};
  } catch (const Error& error) {
    const auto* missing = dynamic_cast<const config::MissingDescription*>(&error);
    if (missing != nullptr && !missing->remedy().empty())
      return {name, "not here; " + missing->remedy()};
    const std::string text = error.what();
    return {name, text.substr(0, text.find("; "))};
  }
}

Table robots() {
  Table table;
  for (const std::string& name : config::list_data("robots"))
    table.push_back(described_robot(name));
  return table;
}

std::string levels_of(const control::StackOptions& stack) {
  std::string levels;
  for (const control::LevelSpec& level : stack.levels)
    levels += (levels.empty() ? "" : " > ") + level.name;
  return levels;
}

Table stacks() {
  Table table;
  for (const std::string& name : config::list_data("stacks")) {
    table.push_back({name, config::describe_data("stacks", name)});
    table.push_back({"", levels_of(config::load_stack(name))});
  }
  return table;
}

/// Names and descriptions of the files in a data folder.
Table described(const std::string& folder) {
  Table table;
  for (const std::string& name : config::list_data(folder)) {
    table.push_back({name, config::describe_data(folder, name)});
  }
  return table;
}

Table tasks(const Scale& scale) {
  Table table;
  for (const tasks::TaskInfo& task : tasks::task_catalog()) {
    table.push_back(
        {std::string(task.name), std::string(task.equation), std::string(task.summary)});
    for (const tasks::TaskParameter& parameter : task.parameters) {
      table.push_back({"  " + std::string(parameter.name),
                       number(config::default_of(parameter, scale)),
                       std::string(parameter.unit) + "  " + std::string(parameter.help)});
    }
    for (const tasks::TaskChoice& choice : task.choices) {
      std::string values;
      for (const std::string& word : tasks::words_of(choice))
        values += (values.empty() ? "" : " | ") + word;
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
  for (const std::string& name : config::list_data(kFolder)) {
    table.push_back({name});
    for (const auto& [path, range] :
         config::parse_yaml_file(config::find_data_file(kFolder, name)).members) {
      table.push_back({"  " + path, config::to_json(range)});
    }
  }
  return table;
}

Table options(const std::vector<config::OptionRow>& rows) {
  Table table;
  for (const config::OptionRow& row : rows)
    table.push_back(
        {row.key, row.value + (row.unit.empty() ? "" : " " + row.unit), row.range, row.help});
  return table;
}

std::string options_json(const std::vector<config::OptionRow>& rows) {
  std::string text;
  logging::JsonText json(text);
  json.array();
  for (const config::OptionRow& row : rows) {
    json.object().member("key", row.key).member("default", row.value).member("unit", row.unit);
    json.member("range", row.range).member("help", row.help).end_object();
  }
  json.end_array();
  return text + "\n";
}

std::string whose_defaults(const model::RobotDescription& robot) {
  return "Defaults of " + robot.name + "; --robot NAME lists those of another robot.\n\n";
}

int list_options_command(const ListFilter& filter) {
  const model::RobotDescription robot = config::load_robot(filter.robot);
  const std::vector<config::OptionRow> rows = config::list_options(filter.about, robot);
  if (rows.empty()) throw Error("no option begins with \"" + filter.about + "\"");
  std::cout << (filter.json ? options_json(rows)
                            : printable(whose_defaults(robot) + aligned(options(rows)), "\n"));
  return kPassed;
}

int list_tasks_command(const ListFilter& filter) {
  const model::RobotDescription robot = config::load_robot(filter.robot);
  std::cout << printable(whose_defaults(robot) + aligned(tasks(robot.scale)), "\n")
            << "Tasks of your own are known to the program alone that registers them.\n";
  return kPassed;
}

int list_schema_command(const std::string& kind) {
  const std::vector<std::string>& kinds = config::kinds_of_files();
  if (std::ranges::find(kinds, kind) == kinds.end())
    throw Error("a schema is of a kind of file; " + valid_names(kind, kinds));
  std::cout << config::json_schema(kind) << "\n";
  return kPassed;
}

}  // namespace

const std::vector<std::string>& listable() {
  static const std::vector<std::string> kListable{"robots",         "stacks",  "gaits",
                                                  "scenarios",      "tasks",   "metrics",
                                                  "randomisations", "options", "schema"};
  return kListable;
}

int list_command(const std::string& what, const ListFilter& filter) {
  const std::vector<std::string>& all = listable();
  if (std::ranges::find(all, what) == all.end())
    throw Error((what.empty() ? "say what to list; " : "there is no list \"" + what + "\"; ") +
                valid_names(what, all));
  if (what == "options") return list_options_command(filter);
  if (what == "schema") return list_schema_command(filter.about);
  if (!filter.about.empty()) throw Error("only of options and schemas there is a part to list");
  if (what == "tasks") return list_tasks_command(filter);
  if (what == "metrics") {
    std::cout << (filter.json ? metrics_json().dump() + "\n" : metrics_text());
    return kPassed;
  }
  Table table;
  if (what == "robots") table = robots();
  if (what == "stacks") table = stacks();
  if (what == "scenarios" || what == "gaits") table = described(what);
  if (what == "randomisations") table = randomisations();
  std::cout << printable(aligned(table), "\n");
  return kPassed;
}

}  // namespace surefoot::cli
