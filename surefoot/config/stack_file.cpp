#include "surefoot/config/stack_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/tasks/catalog.hpp"

#include <algorithm>
#include <iterator>

namespace surefoot::config {
namespace {

template <typename Named>
std::vector<std::string> names_of(const Named& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

/// A word, or a list of them.
std::string read_words(const ConfigNode& node, const std::string& path) {
  if (node.kind == ConfigNode::Kind::null) return "none";
  if (node.kind != ConfigNode::Kind::list) return read_text(node, path);
  std::string words;
  for (const ConfigNode& word : node.items)
    words += (words.empty() ? "" : " ") + read_text(word, path);
  return words;
}

/// Reads a parameter: a number or the name of a choice, according to the catalog.
void read_parameter(const ConfigNode& node, const std::string& key, const std::string& path,
                    const tasks::OwnTasks& own, control::TaskSpec& task) {
  const tasks::TaskInfo& info = tasks::task_info(task.task, own);
  const std::vector<std::string> numbers = names_of(info.parameters),
                                 choices = names_of(info.choices);
  tasks::TaskParameters parameter;
  if (contains(numbers, key)) {
    parameter.numbers[key] = task.numbers[key] = read_number(node, path);
  } else if (contains(choices, key)) {
    parameter.choices[key] = task.choices[key] = read_words(node, path);
  } else {
    std::vector<std::string> valid = numbers;
    valid.insert(valid.end(), choices.begin(), choices.end());
    fail_at(node, path,
            "the task " + task.task + " has no such parameter; " + valid_names(key, valid));
  }
  try {
    (void)tasks::make_task(task.task, parameter, own);
  } catch (const Error& error) {
    fail_at(node, path, error.what());
  }
}

/// `is_level`: keys of the level stand next to the parameters.
control::TaskSpec read_task(const ConfigNode& node, const std::string& path,
                            const tasks::OwnTasks& own, bool is_level) {
  Section section(node, path);
  control::TaskSpec task;
  section.text("task", task.task);
  section.number("weight", task.weight, kPositive);
  if (section.node("task") == nullptr) section.fail("task", "this key is missing");
  const std::vector<std::string> valid = tasks::task_names(own);
  if (!contains(valid, task.task)) {
    section.fail("task", "unknown task \"" + task.task + "\"; " + valid_names(task.task, valid));
  }
  std::vector<std::string> others{"task", "weight"};
  if (is_level) others.insert(others.end(), {"name", "damping"});
  for (const std::string& key : others) (void)section.node(key.c_str());
  for (const std::string& key : section.keys()) {
    if (contains(others, key)) continue;
    read_parameter(*section.node(key.c_str()), key, section.path_of(key), own, task);
  }
  section.finish();
  return task;
}

std::vector<control::TaskSpec> read_task_list(const ConfigNode& list, const std::string& path,
                                              const tasks::OwnTasks& own) {
  if (list.items.empty()) fail_at(list, path, "must be a list of at least one task");
  std::vector<control::TaskSpec> tasks;
  for (const ConfigNode& item : list.items) tasks.push_back(read_task(item, path, own, false));
  return tasks;
}

control::LevelSpec read_level(const ConfigNode& node, const std::string& path,
                              const tasks::OwnTasks& own) {
  control::LevelSpec level;
  if (const ConfigNode* tasks = node.find("tasks")) {
    Section section(node, path);
    double weight = 1.0;
    section.require("name");
    section.text("name", level.name);
    section.number("weight", weight, kPositive);
    section.number("damping", level.damping, kNotNegative);
    level.tasks = read_task_list(*tasks, path, own);
    for (control::TaskSpec& task : level.tasks) task.weight *= weight;
    (void)section.node("tasks");
    section.finish();
  } else {
    level.tasks.push_back(read_task(node, path, own, true));
    const ConfigNode* name = node.find("name");
    level.name = name == nullptr ? level.tasks.front().task : read_text(*name, path + ".name");
    if (const ConfigNode* damping = node.find("damping")) {
      level.damping = read_number(*damping, path + ".damping", kNotNegative);
    }
  }
  return level;
}

std::vector<std::string> task_names(const control::StackOptions& stack) {
  std::vector<std::string> names;
  for (const control::LevelSpec& level : stack.levels) {
    for (const control::TaskSpec& task : level.tasks) names.push_back(task.task);
  }
  return names;
}

void override_task(control::StackOptions& stack, const std::string& name,
                   const ConfigNode& parameters, const std::string& path) {
  for (control::LevelSpec& level : stack.levels) {
    for (control::TaskSpec& task : level.tasks) {
      if (task.task != name) continue;
      for (const auto& [key, value] : parameters.members) {
        read_parameter(value, key, path + "." + key, stack.own_tasks, task);
      }
    }
  }
}

}  // namespace

namespace {

/// The base's level of this name.
control::LevelSpec take_level(const ConfigNode& name, const std::string& path,
                              const std::vector<control::LevelSpec>& base) {
  const auto found = std::ranges::find(base, name.text, &control::LevelSpec::name);
  if (found != base.end()) return *found;
  fail_at(name, path,
          "unknown level \"" + name.text + "\"" +
              (base.empty()
                   ? "; a level by its name needs a base: the stack that has it"
                   : "; " + valid_names(name.text, names_of(base)) +
                         "; a task that the base has not is a level as {task: " + name.text + "}"));
}

/// Scaling of a file's numbers to the robot.
struct Fit {
  const Scale& scale;
  const tasks::OwnTasks& own;
  bool is_scaled;  ///< false: only defaults are scaled
};

control::LevelSpec read_level(const ConfigNode& node, const std::string& path, const Fit& fit) {
  control::LevelSpec level = read_level(node, path, fit.own);
  scale_level(level, fit.scale, fit.own, !fit.is_scaled);
  return level;
}

/// Reads the file's own levels, and inserts the base's levels that are named among them.
void read_levels(const ConfigNode& levels, const std::vector<control::LevelSpec>& base,
                 const Fit& fit, control::StackOptions& stack) {
  if (levels.items.empty()) fail_at(levels, "levels", "must be a list of at least one level");
  for (std::size_t i = 0; i < levels.items.size(); ++i) {
    const ConfigNode& level = levels.items[i];
    const std::string path = "levels." + std::to_string(i);
    stack.levels.push_back(level.kind == ConfigNode::Kind::scalar ? take_level(level, path, base)
                                                                  : read_level(level, path, fit));
  }
}

void leave_out(const ConfigNode& without, control::StackOptions& stack) {
  if (without.items.empty()) {
    fail_at(without, "without",
            "must be a list of at least one level, such as [" + stack.levels.back().name + "]; " +
                valid_names(without.text, names_of(stack.levels)));
  }
  for (const ConfigNode& name : without.items) {
    const std::vector<std::string> names = names_of(stack.levels);
    if (!contains(names, read_text(name, "without"))) {
      fail_at(name, "without",
              "unknown level \"" + name.text + "\"; " + valid_names(name.text, names));
    }
    std::erase_if(stack.levels,
                  [&](const control::LevelSpec& level) { return level.name == name.text; });
  }
}

/// Multiplies the tasks' weights by those of their levels, given by name.
void weigh(Section& weights, control::StackOptions& stack) {
  for (control::LevelSpec& level : stack.levels) {
    double weight = 1.0;
    weights.number(level.name.c_str(), weight, kPositive);
    for (control::TaskSpec& task : level.tasks) task.weight *= weight;
  }
}

/// Merges all levels from the named one on into one weighted level. Weights of levels that had
/// several tasks are scaled already.
control::StackOptions merge(const ConfigNode& name, control::StackOptions stack, const Fit& fit) {
  const std::vector<std::string> names = names_of(stack.levels);
  const auto found = std::ranges::find(names, read_text(name, "weighted_from"));
  if (found == names.end()) {
    fail_at(name, "weighted_from",
            "unknown level \"" + name.text + "\"; " + valid_names(name.text, names));
  }
  if (fit.is_scaled) {
    for (control::LevelSpec& level : stack.levels) {
      if (level.tasks.size() == 1) scale_weights(level, fit.scale, fit.own);
    }
  }
  try {
    return control::weighted_from(std::move(stack),
                                  static_cast<std::size_t>(found - names.begin()));
  } catch (const Error& error) {
    fail_at(name, "weighted_from", error.what());
  }
}

/// The levels of another stack.
std::vector<control::LevelSpec> read_base(const Section& top, const ConfigNode& base,
                                          const std::filesystem::path& folder, const Fit& fit) {
  try {
    return load_stack(read_text(base, "base"), folder, fit.scale, fit.own).levels;
  } catch (const UnknownNameError& error) {
    top.fail("base", error.what());
  }
}

/// `folder`: searched for the base.
control::StackOptions read_stack(ConfigNode tree, const std::filesystem::path& folder,
                                 const Scale& scale, const tasks::OwnTasks& own) {
  const Fit fit{scale, own, take_scaled(tree)};
  Section top(tree, "");
  control::StackOptions stack{.name = {}, .levels = {}, .own_tasks = own};
  std::string description;
  top.require("name");
  top.text("name", stack.name);
  top.text("description", description);
  const ConfigNode* base = top.node("base");
  const ConfigNode* without = top.node("without");
  const ConfigNode* levels = top.node("levels");
  if (base == nullptr && without != nullptr)
    top.fail("without", "needs a base: the stack whose levels it leaves out");
  const ConfigNode* weights = top.node("weights");
  const ConfigNode* weighted = top.node("weighted_from");
  if (base == nullptr) top.require("levels");
  top.finish();
  if (without != nullptr && levels != nullptr)
    top.fail("without", "there are levels, too: what they don't name is left out already");
  std::vector<control::LevelSpec> below;
  if (base != nullptr) below = read_base(top, *base, folder, fit);
  if (levels != nullptr) {
    read_levels(*levels, below, fit, stack);
  } else {
    stack.levels = std::move(below);
  }
  if (without != nullptr) leave_out(*without, stack);
  if (weights != nullptr) top.section("weights", [&](Section& map) { weigh(map, stack); });
  return weighted == nullptr ? stack : merge(*weighted, std::move(stack), fit);
}

}  // namespace

control::StackOptions load_stack(const std::string& name_or_path,
                                 const std::filesystem::path& beside, const Scale& scale,
                                 const tasks::OwnTasks& own) {
  const std::filesystem::path file = find_data_file("stacks", name_or_path, beside);
  return read_stack(parse_yaml_file(file), file.parent_path(), scale, own);
}

control::StackOptions parse_stack(const std::string& text, const std::string& name,
                                  const Scale& scale, const tasks::OwnTasks& own) {
  return read_stack(parse_yaml_map(text, name), {}, scale, own);
}

// Defaults are for a robot of scale 1.
control::StackOptions with_scaled_arms(const control::StackOptions& stack,
                                       const model::RobotDescription& robot) {
  control::StackOptions result = control::with_stops(
      control::with_further_joints(control::with_arms(stack, robot), robot), robot);
  for (control::LevelSpec& level : result.levels) {
    const bool is_new = !contains(names_of(stack.levels), level.name);
    if (is_new) scale_level(level, robot.scale, {}, true);
  }
  return result;
}

std::vector<std::filesystem::path> stack_files(const std::string& name_or_path,
                                               const std::filesystem::path& beside) {
  std::vector<std::filesystem::path> files{find_data_file("stacks", name_or_path, beside)};
  const ConfigNode tree = parse_yaml_file(files.front());
  if (const ConfigNode* base = tree.find("base")) {
    std::ranges::copy(stack_files(read_text(*base, "base"), files.front().parent_path()),
                      std::back_inserter(files));
  }
  return files;
}

void override_tasks(control::StackOptions& stack, const ConfigNode& tasks,
                    const std::string& path) {
  Section section(tasks, path);
  const std::vector<std::string> names = task_names(stack);
  for (const std::string& name : section.keys()) {
    if (std::ranges::find(names, name) == names.end()) {
      section.fail(
          name, "the stack \"" + stack.name + "\" has no such task; " + valid_names(name, names));
    }
    const ConfigNode& parameters = *section.node(name.c_str());
    (void)Section(parameters, section.path_of(name));  // throws unless it is a map
    override_task(stack, name, parameters, section.path_of(name));
  }
}

}  // namespace surefoot::config
