#include "surefoot/control/stack_options.hpp"

#include <utility>

namespace surefoot {

StackOptions weighted_from(StackOptions stack, std::size_t first) {
  if (first >= stack.levels.size()) return stack;
  LevelSpec weighted{.name = "weighted", .tasks = {}};
  for (std::size_t k = first; k < stack.levels.size(); ++k) {
    for (TaskSpec& task : stack.levels[k].tasks) weighted.tasks.push_back(std::move(task));
  }
  stack.levels.resize(first);
  stack.levels.push_back(std::move(weighted));
  return stack;
}

}  // namespace surefoot
