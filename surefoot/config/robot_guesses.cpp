#include "surefoot/config/robot_guesses.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/config/config_tree.hpp"

#include <algorithm>
#include <optional>

namespace surefoot::config {
namespace {

/// Does the file tell all of them, each by its dotted path?
bool has_all(const ConfigNode& file, std::initializer_list<const char*> paths) {
  return std::ranges::all_of(paths, [&](const std::string path) {
    const std::size_t dot = path.find('.');
    const ConfigNode* outer = file.find(path.substr(0, dot));
    return outer != nullptr && outer->find(path.substr(dot + 1)) != nullptr;
  });
}

/// Or does each leg, or limb, tell its own?
bool each_has_posture(const ConfigNode& file, const char* limbs) {
  const ConfigNode* node = file.find(limbs);
  return node != nullptr && std::ranges::all_of(node->members, [](const auto& limb) {
           return limb.second.find("posture") != nullptr;
         });
}

std::optional<ConfigNode> robot_file_of(const Scenario& scenario) {
  const auto source = std::ranges::find(scenario.sources, "robot.yaml", &SourceFile::name);
  if (source == scenario.sources.end()) return std::nullopt;
  return parse_yaml(source->text, source->name);
}

}  // namespace

std::string guessed_note(const Scenario& scenario) {
  const std::optional<ConfigNode> file = robot_file_of(scenario);
  const ConfigNode* guessed = file ? file->find("guessed") : nullptr;
  if (guessed == nullptr) return "";
  std::string numbers;
  for (const ConfigNode& number : guessed->items)
    numbers += (numbers.empty() ? "" : "; ") + number.text;
  return kGuessed + scenario.robot.name + ", not measured: " + numbers;
}

std::string robot_guesses(const Scenario& scenario) {
  const std::optional<ConfigNode> read = robot_file_of(scenario);
  if (!read) return "";
  const ConfigNode& file = *read;
  const model::RobotDescription& robot = scenario.robot;
  std::string taken;
  const auto add = [&](const std::string& text) { taken += (taken.empty() ? "" : "; ") + text; };
  if (robot.can_walk() && !has_all(file, {"drives.stall_torque", "drives.no_load_speed"}))
    add("drives as strong and fast as limits");
  if (robot.can_walk() && !has_all(file, {"posture.nominal"}) && !each_has_posture(file, "legs"))
    add("posture with knees bent by 0.8 rad");
  if (!has_all(file, {"gains.hold", "gains.damping"}))
    add(formatted("gains of ANYmal B, to size: hold %.3g N·m/rad, damping %.3g N·m·s/rad at KFE",
                  robot.hold_kp[2], robot.damping_kd[2]));
  return taken.empty() ? "" : "not in the file of " + robot.name + ", so that is taken: " + taken;
}

}  // namespace surefoot::config
