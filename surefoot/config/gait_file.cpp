#include "surefoot/config/gait_file.hpp"

#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/field_reader.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/section.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

namespace fs = std::filesystem;

void erase(ConfigNode& map, const char* key) {
  std::erase_if(map.members, [&](const ConfigNode::Member& member) { return member.first == key; });
}

/// A rhythm must be given for each leg of the robot, and for no other.
void check_legs(const ConfigNode& gait, const model::RobotDescription& robot) {
  if (!robot.can_walk())
    fail_at(gait, "gait", robot.name + " has flat feet and only stands; it has no gait");
  const ConfigNode* rhythm = gait.find("rhythm");
  const ConfigNode* offset = rhythm == nullptr ? nullptr : rhythm->find("offset");
  if (offset == nullptr || offset->kind != ConfigNode::Kind::map) return;
  std::string given, legs;
  for (const auto& [leg, share] : offset->members) given += " " + leg;
  for (const std::string_view leg : leg_names(robot.num_legs())) legs += " " + std::string(leg);
  const auto lacks = [&](std::string_view leg) { return offset->find(leg) == nullptr; };
  const auto names = leg_names(robot.num_legs());
  if (offset->members.size() != names.size() || std::ranges::any_of(names, lacks))
    fail_at(*offset, "rhythm.offset",
            "is given for the legs" + given + ", but " + robot.name + " has" + legs +
                "; valid is a gait that has an offset for each of them, and for no other");
}

/// The file's options as a scenario has them, below `planner:`.
ConfigNode read_gait(const fs::path& file, const model::RobotDescription* robot) {
  ConfigNode gait = parse_yaml_file(file);
  const bool is_scaled = take_scaled(gait);
  erase(gait, "description");
  if (robot != nullptr) check_legs(gait, *robot);
  ConfigNode scenario{.kind = ConfigNode::Kind::map, .where = gait.where};
  const ConfigNode* rhythm = gait.find("rhythm");
  if (rhythm == nullptr || rhythm->find("enabled") == nullptr) {
    set_path(gait, "rhythm.enabled",
             {.kind = ConfigNode::Kind::scalar, .text = "true", .where = gait.where});
  }
  scenario.members.emplace_back("planner", std::move(gait));
  if (is_scaled && robot != nullptr) fit_scenario(scenario, *robot);
  return scenario;
}

}  // namespace

void remove_gait(ConfigNode& scenario) { erase(scenario, "gait"); }

Group gait_fields(gaits::PlannerOptions& planner, std::string& description) {
  return Group{{"description", &description, "for lists and tables"},
               {kScaled, Other{"flag"}, "numbers are for ANYmal B"}}
      .and_also(fields(planner));
}

std::optional<fs::path> include_gait(ConfigNode& scenario, const ConfigNode& name,
                                     const fs::path& folder, const model::RobotDescription* robot,
                                     const gaits::OwnGaits& own) {
  if (name.kind == ConfigNode::Kind::null || own.find(name.text) != nullptr) return std::nullopt;
  try {
    const fs::path file = find_data_file("gaits", read_text(name, "gait"), folder);
    ConfigNode below = read_gait(file, robot);
    merge(below, std::move(scenario));
    scenario = std::move(below);
    return file;
  } catch (const UnknownNameError& error) {
    std::string yours;
    for (const std::string& gait : own.names()) yours += ", " + gait;
    fail_at(name, "gait", error.what() + yours);
  }
}

}  // namespace surefoot::config
