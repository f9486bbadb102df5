#include "surefoot/config/loaded_gaits.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/section.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

namespace surefoot::config {
namespace {

/// From slow to fast.
constexpr std::array kOfAuto{"crawl", "trot", "flying_trot"};

ConfigNode text_node(std::string text, const std::string& where) {
  return {.kind = ConfigNode::Kind::scalar, .text = std::move(text), .where = where};
}

std::string name_of(const ConfigNode& gait) {
  return std::filesystem::path(gait.text).stem().string();
}

bool is_auto(const ConfigNode* gait) { return gait != nullptr && gait->text == kAutoGait; }

/// The names in the scenario, with those that `auto` stands for.
class GaitNames {
 public:
  void add(const ConfigNode* gait) {
    if (gait == nullptr || gait->kind == ConfigNode::Kind::null) return;
    (void)read_text(*gait, "gait");
    if (is_auto(gait)) {
      for (const char* name : kOfAuto) add_one(text_node(name, gait->where));
    } else {
      add_one(*gait);
    }
  }
  [[nodiscard]] const std::vector<ConfigNode>& all() const { return all_; }

 private:
  void add_one(const ConfigNode& gait) {
    const auto is_same = [&](const ConfigNode& one) { return name_of(one) == name_of(gait); };
    if (std::ranges::none_of(all_, is_same)) all_.push_back(gait);
  }
  std::vector<ConfigNode> all_;
};

GaitNames names_in(const ConfigNode& tree, const ConfigNode* own) {
  GaitNames names;
  const ConfigNode *listed = tree.find("gaits"), *user = tree.find("user");
  if (listed != nullptr && listed->kind != ConfigNode::Kind::null) {  // as logs have it
    if (listed->kind != ConfigNode::Kind::list)
      fail_at(*listed, "gaits", "must be a list of names");
    for (const ConfigNode& gait : listed->items) names.add(&gait);
  }
  const bool is_given = !names.all().empty();
  if (!is_given || !is_auto(own)) names.add(own);
  if (user == nullptr) return names;
  for (const ConfigNode& command : user->items) {
    const ConfigNode* gait = command.find("gait");
    if (!is_given || !is_auto(gait)) names.add(gait);
  }
  return names;
}

}  // namespace

ConfigNode slowest(const ConfigNode& gait) {
  return is_auto(&gait) ? text_node(kOfAuto.front(), gait.where) : gait;
}

void load_gaits(ConfigNode& tree, const ConfigNode* own, const gaits::OwnGaits& of_user,
                const std::function<ConfigNode(const ConfigNode& name)>& planner_of) {
  const bool has_own = own != nullptr && own->kind != ConfigNode::Kind::null;
  const GaitNames names = names_in(tree, own);
  const bool is_of_user = has_own && of_user.find(own->text) != nullptr;
  const ConfigNode* listed = tree.find("gaits");
  const bool is_listed = listed != nullptr && listed->kind == ConfigNode::Kind::list;
  const std::size_t least = has_own && !is_of_user && !is_listed ? 2 : 1;
  if (names.all().size() < least) return set_path(tree, "gaits", {});
  ConfigNode planners{.kind = ConfigNode::Kind::map, .where = tree.where};
  for (const ConfigNode& gait : names.all())
    planners.members.emplace_back(name_of(gait), planner_of(gait));
  set_path(tree, "gaits", std::move(planners));
  if (has_own) set_path(tree, "gait", text_node(name_of(*own), own->where));
}

void draw_gaits(ConfigNode& tree, const std::vector<RandomDraw>& drawn) {
  const ConfigNode* gaits = tree.find("gaits");
  if (gaits == nullptr) return;
  std::vector<std::string> names;
  for (const auto& [name, planner] : gaits->members) names.push_back(name);
  for (const RandomDraw& draw : drawn) {
    const std::string planner = "planner.";
    if (!draw.path.starts_with(planner)) continue;
    for (const std::string& name : names) {
      set_path(tree, "gaits." + name + "." + draw.path.substr(planner.size()),
               text_node(shortest_text(draw.value), "seed"));
    }
  }
}

void read_gaits(const ConfigNode& tree, const gaits::OwnGaits& of_user,
                const std::function<gaits::PlannerOptions(const ConfigNode& scenario)>& read,
                Scenario& scenario) {
  const ConfigNode* given = tree.find("gaits");
  if (given == nullptr || given->kind != ConfigNode::Kind::map) return;
  control::ControllerOptions& controller = scenario.controller;
  ConfigNode other = tree;
  std::erase_if(other.members, [](const auto& member) { return member.first == "gaits"; });
  std::vector<std::string> names;
  for (const auto& [name, planner] : given->members) {
    set_path(other, "planner", planner);
    const gaits::GaitFactory* make = of_user.find(name);
    controller.gaits.push_back({name, read(other), make == nullptr ? gaits::GaitFactory() : *make});
    names.push_back(name);
  }
  const auto place = [&](const std::string& name, const ConfigNode& where) {
    if (name.empty()) return UserCommand::kOwnGait;
    if (name == kAutoGait) return UserCommand::kAutoGait;
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      fail_at(where, "gait", "the scenario loads no such gait; " + valid_names(name, names));
    return static_cast<int>(found - names.begin());
  };
  const ConfigNode* own = tree.find("gait");
  if (own != nullptr) controller.first_gait = place(own->text, *own);
  for (TimedCommand& command : scenario.commands)
    command.user.gait = place(
        command.gait == kAutoGait ? kAutoGait : std::filesystem::path(command.gait).stem().string(),
        *given);
}

std::vector<std::string> gait_names(const std::vector<gaits::NamedGait>& gaits) {
  std::vector<std::string> names;
  bool has_choice = false;
  for (const gaits::NamedGait& gait : gaits) {
    names.push_back(gait.name);
    has_choice = has_choice || gait.options.rhythm.chosen_to > 0.0;
  }
  if (has_choice) names.emplace_back(kAutoGait);
  return names;
}

std::string valid_gaits(const std::string& given, const std::vector<std::string>& names) {
  if (!names.empty()) return valid_names(given, names);
  return "the scenario has one gait alone; with gaits=[crawl, trot] it has both";
}

int gait_place(const std::string& name, const std::vector<std::string>& names) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw UnknownNameError("unknown gait \"" + name + "\"; " + valid_gaits(name, names));
  return name == kAutoGait ? UserCommand::kAutoGait : static_cast<int>(found - names.begin());
}

}  // namespace surefoot::config
