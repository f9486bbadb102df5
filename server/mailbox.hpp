#pragma once

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

namespace surefoot::server {

/// Hands letters from one thread to another, in order and however many, without locks: whoever
/// puts one in never waits for whoever takes them out.
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

  /// All that were put in and not taken yet, the oldest first.
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
