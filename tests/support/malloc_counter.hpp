#pragma once

#include <cstddef>

namespace surefoot::test {

/// Counts the calls of this thread to malloc, calloc, realloc and their aligned kin, whoever makes
/// them (operator new and Eigen end there too), from its construction on. Linking this file puts
/// the counting functions in the place of the C library's.
class MallocCounter {
 public:
  MallocCounter();
  [[nodiscard]] std::size_t count() const;

 private:
  std::size_t start_;
};

}  // namespace surefoot::test
