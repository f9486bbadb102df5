#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace surefoot::solver {

/// While alive, overflow gives infinity and invalid operations NaN, without an exception: no trap
/// of the caller, and no flag afterwards. For checks whether squares of given numbers overflow.
class QuietOverflow {
 public:
#if defined(__SSE2__)
  QuietOverflow() { write(saved_ | kMasked); }
  ~QuietOverflow() { write(saved_); }
#else
  QuietOverflow() { std::feholdexcept(&saved_); }
  ~QuietOverflow() { std::fesetenv(&saved_); }
#endif
  QuietOverflow(const QuietOverflow&) = delete;
  QuietOverflow& operator=(const QuietOverflow&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kMasked = 0x1f80;  // all six

  // The barriers keep reads and writes in between.
  static void write(unsigned mode) {
    asm volatile("" ::: "memory");
    _mm_setcsr(mode);
    asm volatile("" ::: "memory");
  }

  unsigned saved_ = _mm_getcsr();
#else
  std::fenv_t saved_{};
#endif
};

}  // namespace surefoot::solver
