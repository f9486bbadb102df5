#pragma once

#include <array>
#include <string>
#include <vector>

namespace surefoot {

/// Of the enumerators of an enumeration with `name(Enum)`, in order.
template <typename Enum, std::size_t N>
[[nodiscard]] std::vector<std::string> names_of(const std::array<Enum, N>& all) {
  std::vector<std::string> names;
  for (const Enum one : all) names.emplace_back(name(one));
  return names;
}

}  // namespace surefoot
