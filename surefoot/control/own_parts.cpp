#include "surefoot/control/own_parts.hpp"

#include <algorithm>

namespace surefoot::control {

bool has_own_gait(const ControllerOptions& options) {
  return std::ranges::any_of(options.gaits,
                             [](const gaits::NamedGait& gait) { return bool(gait.make); });
}

std::vector<std::string> own_gaits_and_tasks(const ControllerOptions& options) {
  std::vector<std::string> found;
  for (const gaits::NamedGait& gait : options.gaits)
    if (gait.make) found.push_back("gait " + gait.name);
  for (const LevelSpec& level : options.stack.levels) {
    for (const TaskSpec& task : level.tasks) {
      const std::string own = "task " + task.task;
      const bool is_own = options.stack.own_tasks.find(task.task) != nullptr;
      if (is_own && std::ranges::find(found, own) == found.end()) found.push_back(own);
    }
  }
  return found;
}

}  // namespace surefoot::control
