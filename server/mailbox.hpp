#pragma once

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace surefoot::server {

/// An unbounded queue between threads without locks: the sender never waits.
template <typename T>
class Mailbox {
 public:
  Mailbox() = default;
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;
  ~Mailbox() { (void)take(); }

  void put(T content) {
    auto* letter = new Letter{std::move(content), last_.load(std::memory_order_relaxed)};
    while (!last_.compare_exchange_weak(letter->before, letter, std::memory_order_release,
                                        std::memory_order_relaxed)) {
    }
  }

  /// All contents that were not taken yet, oldest first.
  [[nodiscard]] std::vector<T> take() {
    std::vector<T> contents;
    Letter* letter = last_.exchange(nullptr, std::memory_order_acquire);
    while (letter != nullptr) {
      contents.push_back(std::move(letter->content));
      delete std::exchange(letter, letter->before);
    }
    std::ranges::reverse(contents);
    return contents;
  }

 private:
  struct Letter {
    T content;
    Letter* before;
  };

  std::atomic<Letter*> last_{nullptr};
};

}  // namespace surefoot::server
