#include "surefoot/config/switch_section.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/control/level_switcher.hpp"

namespace surefoot {
namespace {

void read_names(Section& section, const char* key, std::vector<std::string>& names) {
  const ConfigNode* list = section.node(key);
  if (list == nullptr) return;
  if (list->items.empty()) section.fail(key, "must be a list of names of levels");
  for (const ConfigNode& name : list->items) names.push_back(read_text(name, section.path_of(key)));
}

LevelSwitch read_switch(const ConfigNode& node) {
  LevelSwitch change;
  Section section(node, "stack_switches");
  section.require("time");
  section.number("time", change.time, kNotNegative);
  section.number("duration", change.duration, kNotNegative);
  read_names(section, "add", change.add);
  read_names(section, "remove", change.remove);
  section.finish();
  return change;
}

}  // namespace

std::vector<LevelSwitch> read_level_switches(const ConfigNode& list, const StackOptions& stack) {
  if (list.kind != ConfigNode::Kind::list)
    fail_at(list, "stack_switches", "must be a list of switches, each with its time");
  std::vector<LevelSwitch> switches;
  for (const ConfigNode& item : list.items) {
    switches.push_back(read_switch(item));
    try {
      (void)LevelSwitcher(stack, switches);
    } catch (const Error& error) {
      fail_at(item, "stack_switches", error.what());
    }
  }
  return switches;
}

}  // namespace surefoot
