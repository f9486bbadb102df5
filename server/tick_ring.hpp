#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace surefoot::server {

/// A bounded queue from one thread to another without locks. The writer never waits; without room
/// it must drop its element.
template <typename T>
class TickRing {
 public:
  /// Allocates `capacity` copies of `example`.
  explicit TickRing(std::size_t capacity, const T& example = T()) : slots_(capacity + 1, example) {}

  /// The writer's next element to fill; null: no room. `written` hands it over.
  [[nodiscard]] T* next_to_write() {
    const std::size_t next = after(written_.load(std::memory_order_relaxed));
    if (next == read_.load(std::memory_order_acquire)) return nullptr;
    return &slots_[written_.load(std::memory_order_relaxed)];
  }
  void written() {
    written_.store(after(written_.load(std::memory_order_relaxed)), std::memory_order_release);
  }

  /// The reader's oldest element; null: none. `read` gives its place back.
  [[nodiscard]] const T* next_to_read() const {
    const std::size_t place = read_.load(std::memory_order_relaxed);
    return place == written_.load(std::memory_order_acquire) ? nullptr : &slots_[place];
  }
  void read() {
    read_.store(after(read_.load(std::memory_order_relaxed)), std::memory_order_release);
  }

 private:
  static constexpr std::size_t kCacheLine = 64;

  [[nodiscard]] std::size_t after(std::size_t place) const { return (place + 1) % slots_.size(); }

  std::vector<T> slots_;
  alignas(kCacheLine) std::atomic<std::size_t> written_{0};
  alignas(kCacheLine) std::atomic<std::size_t> read_{0};
};

}  // namespace surefoot::server
