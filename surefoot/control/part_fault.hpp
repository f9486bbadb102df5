#pragma once

#include <algorithm>
#include <array>
#include <exception>
#include <string>
#include <string_view>

namespace surefoot::control {

/// What a part of the user's own did wrong, in words of UTF-8. Does not allocate.
class PartFault {
 public:
  /// Keeps the first fault. The words are joined, and cut where they are too long.
  template <typename... Words>
  void set(const Words&... words) noexcept {
    if (is_set()) return;
    (add(words), ...);
  }
  void clear() noexcept { size_ = 0; }

  [[nodiscard]] bool is_set() const { return size_ > 0; }
  [[nodiscard]] std::string text() const { return {text_.data(), size_}; }

 private:
  void add(std::string_view word) noexcept {
    const auto begins_letter = [&](std::size_t i) { return (word[i] & 0xC0) != 0x80; };
    std::size_t size = std::min(word.size(), text_.size() - size_);
    while (size > 0 && size < word.size() && !begins_letter(size)) --size;
    std::copy_n(word.data(), size, text_.data() + size_);
    size_ += size;
  }

  std::array<char, 240> text_{};
  std::size_t size_ = 0;
};

/// Calls code of the user's own. Returns false if it throws; the fault then says `who` threw what.
template <typename Call, typename... Words>
[[nodiscard]] bool runs(const Call& call, PartFault& fault, const Words&... who) noexcept {
  try {
    call();
    return true;
  } catch (const std::exception& error) {
    fault.set(who..., " threw: ", error.what());
  } catch (...) {
    fault.set(who..., " threw something that is no std::exception");
  }
  return false;
}

}  // namespace surefoot::control
