#pragma once

#include <cstddef>

namespace surefoot::test {

/// Counts the mutexes that this thread locks, or may wait for, from its construction on;
/// `try_lock`, which never waits, is none. Linking this file puts a counting function in the place
/// of the C library's, which std::mutex calls too.
class LockCounter {
 public:
  LockCounter();
  [[nodiscard]] std::size_t count() const;

 private:
  std::size_t start_;
};

}  // namespace surefoot::test
