#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace surefoot {

/// The newest N values of a series.
template <typename T, std::size_t N>
class Recent {
 public:
  void add(const T& value) {
    values_[added_++ % N] = value;
    size_ = std::min(size_ + 1, N);
  }
  void drop_newest() {
    if (size_ == 0) return;
    --added_;
    --size_;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  /// i = 0: the newest one; below size().
  [[nodiscard]] const T& newest(std::size_t i = 0) const { return values_[(added_ - 1 - i) % N]; }

 private:
  std::array<T, N> values_{};
  std::size_t added_ = 0, size_ = 0;
};

}  // namespace surefoot
