#pragma once

#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// Each value of an enumeration with its `name()`, as `Section::choice` wants them.
template <typename Choices>
auto named(const Choices& choices) {
  std::vector<std::pair<std::string, typename Choices::value_type>> result;
  for (const auto choice : choices) result.emplace_back(name(choice), choice);
  return result;
}

}  // namespace surefoot
