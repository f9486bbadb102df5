#include "surefoot/config/scenario_file.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/config_json.hpp"
#include "surefoot/config/criteria_section.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/gait_file.hpp"
#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/loaded_gaits.hpp"
#include "surefoot/config/random_commands.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/robot_plausibility.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/config/scenario_notes.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/level_switcher.hpp"
#include "surefoot/control/stack_reach.hpp"
#include "surefoot/control/standing_torque.hpp"
#include "surefoot/control/task_stack.hpp"
#include "surefoot/math/random_bits.hpp"
#include "surefoot/model/urdf.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

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

/// Criteria of a file are about a run as long as the files have it, also where assignments make
/// it shorter.
void keep_judged_duration(ConfigNode& tree, const std::vector<std::string>& assignments) {
  const ConfigNode* duration = tree.find("duration");
  if (duration == nullptr || tree.find("judged_after") != nullptr) return;
  if (std::ranges::find(assignments, "criteria=none") != assignments.end()) return;
  const bool is_changed = std::ranges::any_of(assignments, [](const std::string& assignment) {
    return assigned_path(assignment) == "duration";
  });
  if (is_changed) tree.members.emplace_back("judged_after", ConfigNode(*duration));
}

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

/// A stack that the robot can't have is refused at the line that names it.
void check_stack(const Section& top, const Scenario& scenario) {
  try {
    control::check_physics(scenario.controller.stack);
    (void)control::TaskStack(scenario.controller.stack, scenario.robot);
  } catch (const Error& error) {
    top.fail("stack", error.what());
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

/// Where a command asks for more than the robot has.
[[noreturn]] void refuse_reach(const ConfigNode& tree, double time, const std::string& what) {
  fail_at(*tree.find("user"), "user", formatted("at %g s, reach%s", time, what.c_str()));
}

/// A name stands for its place among the robot's frames; the stack must follow it.
int followed_frame(const ConfigNode& tree, const TimedCommand& command, const Scenario& scenario) {
  const model::Frames frames(scenario.robot);
  const control::TaskStack stack(scenario.controller.stack, scenario.robot);
  std::vector<std::string> followed;
  for (const model::FollowedFrame& frame : stack.followed_frames())
    followed.push_back(frames.names()[static_cast<std::size_t>(frame.number)]);
  if (std::ranges::find(followed, command.frame) != followed.end())
    return frames.number(command.frame);
  refuse_reach(tree, command.time,
               ".frame: no task of the stack follows \"" + command.frame + "\"; " +
                   valid_names(command.frame, followed));
}

/// Only arms that are there can reach, and frames that the stack follows.
void find_reaches(const ConfigNode& tree, Scenario& scenario) {
  const auto num_arms = static_cast<int>(scenario.robot.arms.size());
  for (TimedCommand& command : scenario.commands) {
    ReachCommand& reach = command.user.reach;
    if (!command.frame.empty()) reach.frame = followed_frame(tree, command, scenario);
    if (reach.arm < num_arms) continue;
    refuse_reach(tree, command.time,
                 formatted(".arm: is %d, but the robot has %s", reach.arm,
                           num_arms == 0 ? "no arms"
                                         : ("arms 0 to " + std::to_string(num_arms - 1)).c_str()));
  }
  const ConfigNode* user = tree.find("user");
  if (user == nullptr) return;
  for (const ConfigNode& command : user->items) {
    const ConfigNode* reach = command.find("reach");
    if (reach == nullptr || reach->kind != ConfigNode::Kind::map) continue;
    if ((reach->find("arm") == nullptr) == (reach->find("frame") == nullptr))
      fail_at(*reach, "user", "reach: needs either the number of an arm, or a frame");
  }
}

/// Pushes must act on links of the robot's URDF.
void check_pushes(const ConfigNode& tree, const Scenario& scenario) {
  const ConfigNode* disturbances = tree.find("disturbances");
  const ConfigNode* pushes = disturbances == nullptr ? nullptr : disturbances->find("pushes");
  if (pushes == nullptr || pushes->members.empty()) return;
  std::vector<std::string> links;
  for (const model::UrdfLink& link : model::read_urdf(scenario.robot).links)
    links.push_back(link.name);
  for (const auto& [name, push] : pushes->members) {
    const ConfigNode* body = push.find("body");
    if (body == nullptr || std::ranges::find(links, body->text) != links.end()) continue;
    fail_at(*body, "disturbances.pushes." + name + ".body",
            "the robot has no link \"" + body->text + "\"; " + valid_names(body->text, links));
  }
}

/// The stack's bounds must be within the robot's reach. The error has the line of the number in the
/// scenario, or else of its stack.
void check_reach(const ConfigNode& tree, const model::RobotModel& model,
                 const control::StackOptions& stack) {
  try {
    control::check_reach(stack, control::reach_of(model));
  } catch (const control::BeyondReachError& error) {
    const ConfigNode* tasks = tree.find("tasks");
    const ConfigNode* task = tasks == nullptr ? nullptr : tasks->find(error.task());
    const ConfigNode* number = task == nullptr ? nullptr : task->find(error.number());
    const std::string message =
        std::string(error.what()) + (model.description().scale.length == 1.0
                                         ? ""
                                         : "; numbers for ANYmal B fit it with scaled: true in "
                                           "their file");
    if (number != nullptr) fail_at(*number, "tasks", message);
    const ConfigNode* named = tree.find("stack");
    fail_at(named == nullptr ? tree : *named, "stack", message);
  }
}

/// The node for errors of the stance: its map, or the number that was drawn.
const ConfigNode& place_of_stance(const ConfigNode& tree) {
  const ConfigNode* planner = tree.find("planner");
  const ConfigNode* stance = planner == nullptr ? nullptr : planner->find("stance");
  if (stance == nullptr) return tree;
  const auto drawn = std::ranges::find_if(
      stance->members, [](const auto& member) { return member.second.where.ends_with(kDrawn); });
  return drawn == stance->members.end() ? *stance : drawn->second;
}

JointVector read_posture(const ConfigNode& tree, const model::RobotModel& model,
                         const gaits::StanceOptions& stance) {
  try {
    return stance_posture(model, stance);
  } catch (const Error& error) {
    fail_at(place_of_stance(tree), "", error.what());
  }
}

/// What a robot with flat feet can't do. Its legs have no names in a scenario, and its plan is for
/// two.
void fit_to_standing(const ConfigNode& tree, Scenario& scenario) {
  if (scenario.robot.can_walk()) return;
  const std::string only = scenario.robot.name + " has flat feet and only stands";
  for (const TimedCommand& command : scenario.commands) {
    if (command.user.walk)
      fail_at(*tree.find("user"), "user",
              formatted("at %g s, walk: %s; valid is false, with height and shift", command.time,
                        only.c_str()));
    if (command.user.calibrate)
      fail_at(
          *tree.find("user"), "user",
          formatted("at %g s, calibrate: %s, and is not calibrated", command.time, only.c_str()));
  }
  if (scenario.plant.initial.is_given)
    fail_at(*tree.find("initial")->find("joints"), "initial.joints",
            only + "; it begins in the posture of its file");
  gaits::set_num_legs(scenario.controller.planner, scenario.robot.num_legs());
}

/// Fills the joints that the scenario does not give with the stance.
void complete_posture(const ConfigNode& tree, const model::RobotModel& model, Scenario& scenario) {
  simulation::InitialState& initial = scenario.plant.initial;
  const JointVector stance = read_posture(tree, model, scenario.controller.planner.stance);
  if (!initial.is_given) initial.q = stance;
  for (Eigen::Index i = 0; i < initial.q.size(); ++i) {
    double& q = initial.q[i];
    if (std::isnan(q)) q = stance[i];
    const model::RobotDescription& robot = scenario.robot;
    if (!initial.is_given || (q >= robot.q_min[i] && q <= robot.q_max[i])) continue;
    const ConfigNode& joints = *tree.find("initial")->find("joints");
    const auto leg = static_cast<std::size_t>(i / kJointsPerLeg);
    const auto joint = static_cast<std::size_t>(i % kJointsPerLeg);
    fail_at(joints, "initial.joints." + std::string(leg_names(robot.num_legs())[leg]),
            formatted("%s is %g rad; valid is %g to %g rad",
                      std::string(kJointNames[joint]).c_str(), q, robot.q_min[i], robot.q_max[i]));
  }
}

/// The torque limits must suffice to stand; else the masses may have a wrong unit.
void check_strength(const ConfigNode& tree, model::RobotModel& model, const JointVector& stance,
                    std::vector<std::string>& notes) {
  const JointVector torque = control::standing_torque(model, stance).cwiseAbs();
  const model::RobotDescription& robot = model.description();
  Eigen::Index i = 0;
  if (torque.cwiseQuotient(robot.torque_limit).maxCoeff(&i) <= 1.0) {
    for (std::string& note : placeholder_notes(robot, torque)) notes.push_back(std::move(note));
    return;
  }
  const ConfigNode* named = tree.find("robot");
  fail_at(
      named == nullptr ? tree : *named, "robot",
      formatted("it can't stand: with %g kg, joint \"%s\" needs %.4g N·m in the stance, and its "
                "limits.torque is %g N·m; check this limit, and the masses in the URDF, in kg",
                model.mass(), robot.joint_names()[static_cast<std::size_t>(i)].c_str(), torque[i],
                robot.torque_limit[i]));
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
  for (const std::string& assignment : request.assignments) {
    if (assignment == "gait=")
      throw Error("--set gait=: a name is missing; gait=none takes the scenario's gait away");
  }
  const fs::path file = find_data_file("scenarios", request.name_or_path);
  const std::optional<model::RobotDescription> fitted = robot_of(file, request);
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
