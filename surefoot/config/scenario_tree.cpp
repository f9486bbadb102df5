#include "surefoot/config/scenario_tree.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/gait_file.hpp"
#include "surefoot/config/loaded_gaits.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/section.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace surefoot::config {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 4;

/// Keys that hold for a file's own experiment only, not for one based on it.
constexpr std::array<std::string_view, 5> kOfOneFile{"description", "criteria", "judged_after",
                                                     "success_rate", "paper"};

/// The files that a scenario was read from: its own, then its bases, and its gait.
struct Files {
  const gaits::OwnGaits& own_gaits;
  std::vector<fs::path> scenarios{};
  std::optional<fs::path> gait{};
  std::optional<ConfigNode> named{};          ///< by the first of the files that names a gait
  std::optional<ConfigNode> instead_of_it{};  ///< another name, to be read in its place
};

/// A gait lies between the file that names it and this file's base, whose gait is not read.
void read_gait(ConfigNode& tree, const fs::path& file, const model::RobotDescription* robot,
               Files& files) {
  const ConfigNode *gaits = tree.find("gaits"), *named = tree.find("gait");
  const bool is_loaded = gaits != nullptr && gaits->kind == ConfigNode::Kind::map;
  if (named == nullptr || is_loaded) return;
  if (!files.named) {
    files.named = *named;
    const ConfigNode name = slowest(files.instead_of_it.value_or(*named));
    files.gait = include_gait(tree, name, file.parent_path(), robot, files.own_gaits);
  }
  remove_gait(tree);
}

/// The file merged over its gait and its `base:`, recursively, each fitted to the robot if it is
/// `scaled`. Adds all of them to `files`.
ConfigNode read_with_base(const fs::path& file, const model::RobotDescription* robot,
                          const std::vector<std::string>& assignments, Files& files) {
  ConfigNode tree = parse_yaml_file(file);
  const bool is_first = files.scenarios.empty();
  files.scenarios.push_back(file);
  if (take_scaled(tree) && robot != nullptr) fit_scenario(tree, *robot);
  for (const std::string& assignment : assignments) {
    if (is_first && assigned_path(assignment) == "gait") apply_assignment(tree, assignment);
  }
  read_gait(tree, file, robot, files);
  const ConfigNode* base = tree.find("base");
  if (base == nullptr) return tree;
  if (files.scenarios.size() > kMaxFiles)
    fail_at(*base, "base", "the files lead to each other, or through too many");
  try {
    ConfigNode below =
        read_with_base(find_data_file("scenarios", read_text(*base, "base"), file.parent_path()),
                       robot, assignments, files);
    std::erase_if(below.members, [](const ConfigNode::Member& member) {
      return std::ranges::find(kOfOneFile, member.first) != kOfOneFile.end();
    });
    merge(below, std::move(tree));
    return below;
  } catch (const UnknownNameError& error) {
    fail_at(*base, "base", error.what());
  }
}

/// All gaits that the scenario can change to, as it would be in each.
void load_gaits(const ScenarioRequest& request, const fs::path& file,
                const model::RobotDescription* robot, const Files& files, ConfigNode& tree) {
  const ConfigNode* loaded = tree.find("gaits");
  if (loaded != nullptr && loaded->kind == ConfigNode::Kind::map) return;
  const auto planner_of = [&](const ConfigNode& name) {
    std::vector<std::string> assignments = request.assignments;
    if (!files.named) assignments.push_back("gait=" + name.text);
    Files others{.own_gaits = request.own_gaits, .instead_of_it = name};
    ConfigNode other = read_with_base(file, robot, assignments, others);
    for (const std::string& assignment : request.assignments) apply_assignment(other, assignment);
    const ConfigNode* planner = other.find("planner");
    return planner == nullptr ? ConfigNode{.kind = ConfigNode::Kind::map} : *planner;
  };
  load_gaits(tree, files.named ? &*files.named : nullptr, request.own_gaits, planner_of);
}

/// The requested robot; none if it can't be loaded, which is reported later.
std::optional<model::RobotDescription> robot_of(const fs::path& file,
                                                const ScenarioRequest& request) {
  const std::vector<std::string>& assignments = request.assignments;
  try {
    Files files{.own_gaits = request.own_gaits};
    ConfigNode tree = read_with_base(file, nullptr, assignments, files);
    for (const std::string& assignment : assignments) {
      if (assigned_path(assignment) == "robot") apply_assignment(tree, assignment);
    }
    const ConfigNode* robot = tree.find("robot");
    if (robot != nullptr) return load_robot(robot->text, file.parent_path());
  } catch (const Error&) {
    return std::nullopt;
  }
  return std::nullopt;
}

/// Removes the paper's figures if assignments turn the scenario into another experiment.
void drop_paper_of_another(ConfigNode& tree, const std::vector<std::string>& assignments) {
  constexpr std::array<std::string_view, 7> kExperiment{"robot", "stack", "gait",        "terrain",
                                                        "user",  "goal",  "disturbances"};
  const bool is_another = std::ranges::any_of(assignments, [&](const std::string& assignment) {
    const std::string path = assigned_path(assignment);
    return std::ranges::find(kExperiment, path.substr(0, path.find('.'))) != kExperiment.end();
  });
  if (is_another)
    std::erase_if(tree.members, [](const auto& member) { return member.first == "paper"; });
}

/// The files' criteria are about a run of the files' duration, also where assignments make it
/// shorter.
void keep_judged_duration(ConfigNode& tree, const std::vector<std::string>& assignments) {
  const ConfigNode* duration = tree.find("duration");
  if (duration == nullptr || tree.find("judged_after") != nullptr) return;
  const auto leaves_none = [](const std::string& assignment) {
    return assignment == "criteria=none" || assignment == "criteria=null";
  };
  if (std::ranges::any_of(assignments, leaves_none)) return;
  const bool is_changed = std::ranges::any_of(assignments, [](const std::string& assignment) {
    return assigned_path(assignment) == "duration";
  });
  if (is_changed) tree.members.emplace_back("judged_after", ConfigNode(*duration));
}

void check_assignments(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    if (assignment == "gait=")
      throw Error("--set gait=: a name is missing; gait=none takes the scenario's gait away");
    if (assigned_path(assignment) == "base")
      throw Error(
          "base: stands in a file alone; give a file of your own that has it, or run its scenario");
  }
}

void check_own_gaits(const gaits::OwnGaits& own) {
  const std::vector<std::string> ours = list_data("gaits");
  for (const std::string& name : own.names()) {
    if (std::ranges::find(ours, name) != ours.end())
      throw Error("there is a gait \"" + name + "\" already; give yours another name");
  }
}

}  // namespace

ScenarioTree read_scenario_tree(const ScenarioRequest& request, const fs::path& file) {
  check_assignments(request.assignments);
  check_own_gaits(request.own_gaits);
  std::optional<model::RobotDescription> fitted = robot_of(file, request);
  const model::RobotDescription* const robot = fitted ? &*fitted : nullptr;
  Files files{.own_gaits = request.own_gaits};
  ConfigNode tree = read_with_base(file, robot, request.assignments, files);
  drop_paper_of_another(tree, request.assignments);
  keep_judged_duration(tree, request.assignments);
  check_taken_ranges(tree, file.parent_path(), request.assignments);
  for (const std::string& assignment : request.assignments) {
    if (assigned_path(assignment) == kScaled)
      throw Error(
          "scaled: stands in a file alone, and says what that file's numbers are for; "
          "numbers of --set are the robot's own");
    apply_assignment(tree, assignment);
  }

  if (tree.find("gaits") == nullptr || tree.find("gaits")->kind != ConfigNode::Kind::map)
    remove_gait(tree);
  load_gaits(request, file, robot, files, tree);
  return {std::move(tree), std::move(fitted), std::move(files.scenarios), std::move(files.gait)};
}

}  // namespace surefoot::config
