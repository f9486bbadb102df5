#include "surefoot/config/scenario_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/config_json.hpp"
#include "surefoot/config/criteria_section.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/loaded_gaits.hpp"
#include "surefoot/config/random_commands.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/scenario_checks.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/config/scenario_notes.hpp"
#include "surefoot/config/scenario_tree.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/level_switcher.hpp"
#include "surefoot/math/random_bits.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

namespace surefoot::config {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> assigned_paths(const ScenarioRequest& request) {
  std::vector<std::string> paths;
  for (const std::string& assignment : request.assignments)
    paths.push_back(assigned_path(assignment));
  return paths;
}

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

void keep_source(Scenario& scenario, const std::string& name, const fs::path& file) {
  scenario.sources.push_back({.name = name, .text = text_of(file)});
}

/// Keeps a file as `name`.yaml, and its bases as `base`1.yaml, `base`2.yaml, …
void keep_sources(Scenario& scenario, const std::string& name, const std::string& base,
                  const std::vector<fs::path>& files) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    keep_source(scenario, (i == 0 ? name : base + std::to_string(i)) + ".yaml", files[i]);
  }
}

std::uint64_t hash_of_sources(const Scenario& scenario) {
  std::uint64_t hash = named_bits(0, model::urdf_text(scenario.robot));
  for (const SourceFile& source : scenario.sources) {
    hash = named_bits(named_bits(hash, source.name), source.text);
  }
  return hash;
}

/// Loads another file by the name at a key; an error about the name has the key's line.
template <typename Load>
auto load_named(Section& top, const char* key, const Load& load) {
  std::string name;
  top.require(key);
  top.text(key, name);
  if (top.node(key) == nullptr) top.fail(key, "this key is missing");
  try {
    return load(name);
  } catch (const UnknownNameError& error) {
    top.fail(key, error.what());
  }
}

void read_paper(Section& section, std::vector<PaperFigure>& paper) {
  const std::vector<std::string> names = metric_names();
  for (const std::string& metric : section.keys()) {
    if (std::ranges::find(names, metric) == names.end()) {
      section.fail(metric, "unknown metric; " + valid_names(metric, names));
    }
    const ConfigNode& text = *section.node(metric.c_str());
    // An empty value removes a figure.
    if (text.kind == ConfigNode::Kind::null) continue;
    paper.push_back({.metric = metric, .text = read_text(text, section.path_of(metric))});
  }
}

/// Of the options: what is of each leg means nothing to a robot that only stands.
int num_legs_of(const model::RobotDescription* robot) {
  return robot == nullptr || !robot->can_walk() ? kNumLegs : robot->num_legs();
}

/// `robot`: gives size and drives of the defaults; null: ANYmal B's.
void read_body(Section& top, const model::RobotDescription* robot, Scenario& scenario) {
  const ConfigNode* actuators = top.node("actuators");
  if (actuators != nullptr && actuators->kind == ConfigNode::Kind::scalar) {
    top.fail("actuators", "\"" + actuators->text +
                              "\" is not a map of keys and values; which model is "
                              "\"actuators.model\": sea or ideal");
  }
  scenario.commands = {TimedCommand{}};
  Group options = scenario_fields(scenario, num_legs_of(robot));
  if (robot != nullptr) fit_defaults(options, *robot, scenario);
  read(top, options);
  const bool has_goal = std::isfinite(scenario.goal.feet_beyond_x);
  top.section("criteria", [&](Section& s) { read_criteria(s, has_goal, scenario.criteria); });
  top.section("paper", [&](Section& s) { read_paper(s, scenario.paper); });
  top.finish();
}

/// Applies the scenario's changes to its stack.
void read_stack_changes(Section& top, control::ControllerOptions& controller) {
  if (const ConfigNode* tasks = top.node("tasks")) {
    override_tasks(controller.stack, *tasks, "tasks");
  }
  const std::vector<control::LevelSwitch>& switches = controller.level_switches;
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const auto end = switches.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    try {
      (void)control::LevelSwitcher(controller.stack, {switches.begin(), end});
    } catch (const Error& error) {
      fail_at(top.node("stack_switches")->items[i], "stack_switches", error.what());
    }
  }
}

/// `robot`: as loaded before; null where that failed, so that it fails here.
void read_robot_and_stack(Section& top, const fs::path& file, const model::RobotDescription* robot,
                          const tasks::OwnTasks& own, Scenario& scenario) {
  const fs::path folder = file.parent_path();
  scenario.robot = load_named(top, "robot", [&](const std::string& name) {
    keep_source(scenario, "robot.yaml", find_data_file("robots", name, folder));
    return robot == nullptr ? load_robot(name, folder) : *robot;
  });
  scenario.controller.stack = load_named(top, "stack", [&](const std::string& name) {
    control::StackOptions stack = load_stack(name, folder, scenario.robot.scale, own);
    keep_sources(scenario, "stack", "stack_base", stack_files(name, folder));
    return with_scaled_arms(stack, scenario.robot);
  });
  read_stack_changes(top, scenario.controller);
  check_stack(top, scenario);
}

/// The scenario with every range of `randomise:` at its lower end, or at its upper. Reading both
/// checks the ranges against the keys' limits for all seeds.
class EndOfRanges {
 public:
  EndOfRanges(ConfigNode tree, const model::RobotDescription* robot) : tree_(std::move(tree)) {
    Section top(tree_, "");
    Scenario scenario;
    read_body(top, robot, scenario);
    controller_ = std::move(scenario.controller);
  }

  /// Checks that need the loaded robot and stack.
  void check(const model::RobotModel& model, const control::StackOptions& stack) {
    Section top(tree_, "");
    controller_.stack = stack;
    read_stack_changes(top, controller_);
    check_reach(tree_, model, controller_.stack);
    (void)read_posture(tree_, model, controller_.planner.stance);
  }

 private:
  ConfigNode tree_;
  control::ControllerOptions controller_;
};

std::vector<EndOfRanges> read_ends(const ConfigNode& tree, const std::vector<std::string>& assigned,
                                   const model::RobotDescription* robot) {
  std::vector<EndOfRanges> ends;
  for (ConfigNode& end : ends_of_ranges(tree, assigned, num_legs_of(robot)))
    ends.emplace_back(std::move(end), robot);
  return ends;
}

}  // namespace

const UserCommand& Scenario::user(double time) const {
  const auto next = std::ranges::upper_bound(commands, time, {}, &TimedCommand::time);
  return (std::max(next, commands.begin() + 1) - 1)->user;
}

std::uint64_t parse_seed(const std::string& number) {
  std::uint64_t seed = 0;
  const char* end = number.data() + number.size();
  const auto [parsed, error] = std::from_chars(number.data(), end, seed);
  if (error == std::errc() && parsed == end && seed <= kLargestSeed) return seed;
  throw Error("seed is " + number + "; valid is a whole number from 0 to " +
              std::to_string(kLargestSeed));
}

Scenario load_scenario(const ScenarioRequest& request) {
  const fs::path file = find_data_file("scenarios", request.name_or_path);
  ScenarioTree files = read_scenario_tree(request, file);
  ConfigNode& tree = files.root;
  const std::optional<model::RobotDescription>& fitted = files.robot;
  const model::RobotDescription* const robot = fitted ? &*fitted : nullptr;

  Scenario scenario;
  scenario.file = file.string();
  scenario.requested = request.name_or_path;
  scenario.assignments = request.assignments;
  scenario.name = file.stem().string();
  scenario.seed = parse_seed(std::to_string(request.seed));
  const std::vector<fs::path> ranges =
      include_ranges(tree, file.parent_path(), fitted ? fitted->scale : Scale{});
  const std::vector<std::string> assigned = assigned_paths(request);
  std::vector<EndOfRanges> ends = read_ends(tree, assigned, robot);
  scenario.drawn = randomise(tree, request.seed, assigned, num_legs_of(robot));
  draw_gaits(tree, scenario.drawn);
  scenario.options_json = to_json(tree);
  keep_sources(scenario, "scenario", "base", files.scenarios);
  if (files.gait) keep_source(scenario, "gait.yaml", *files.gait);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    keep_source(scenario, "randomise" + std::to_string(i + 1) + ".yaml", ranges[i]);
  }
  Section top(tree, "");
  read_body(top, robot, scenario);
  const auto planner_of = [&](const ConfigNode& in_gait) {
    Section section(in_gait, "");
    Scenario other;
    read_body(section, robot, other);
    return other.controller.planner;
  };
  read_gaits(tree, request.own_gaits, planner_of, scenario);
  add_random_commands(scenario);
  read_robot_and_stack(top, file, robot, request.own_tasks, scenario);
  scenario.sources_hash = hash_of_sources(scenario);

  scenario.plant.seed = request.seed;
  check_pushes(tree, scenario);
  find_reaches(tree, scenario);
  check_calibration(tree, scenario);
  fit_to_standing(tree, scenario);
  scenario.notes = scenario_notes(tree, scenario);
  model::RobotModel model(scenario.robot);
  check_reach(tree, model, scenario.controller.stack);
  complete_posture(tree, model, scenario);
  check_strength(tree, model, stance_posture(model, scenario.controller.planner.stance),
                 scenario.notes);
  for (EndOfRanges& end : ends) end.check(model, scenario.controller.stack);
  return scenario;
}

}  // namespace surefoot::config
