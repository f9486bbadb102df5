#pragma once

#include <array>
#include <cstddef>

namespace surefoot {

/// A list in place; further items than kMost are left out.
template <typename T, std::size_t most>
struct BoundedList {
  static constexpr std::size_t kMost = most;
  using value_type = T;

  std::array<T, kMost> items{};
  std::size_t count = 0;

  void add(const T& item) {
    if (count < kMost) items[count++] = item;
  }
  [[nodiscard]] bool empty() const { return count == 0; }
  [[nodiscard]] const T* begin() const { return items.data(); }
  [[nodiscard]] const T* end() const { return items.data() + count; }
};

}  // namespace surefoot
