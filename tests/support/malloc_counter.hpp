#pragma once

extern "C" long surefoot_count_allocations();

namespace surefoot::test {

/// Counts this thread's allocations from its construction on (testing/count_allocations.cpp).
class MallocCounter {
 public:
  MallocCounter() : start_(surefoot_count_allocations()) {}
  [[nodiscard]] unsigned long count() const {
    return static_cast<unsigned long>(surefoot_count_allocations() - start_);
  }

 private:
  long start_;
};

}  // namespace surefoot::test
