#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace surefoot {

/// A short text as `printf` makes it; beyond 255 characters it is cut off.
template <typename... Values>
[[nodiscard]] std::string formatted(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace surefoot
