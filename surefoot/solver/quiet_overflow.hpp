#pragma once

#include <cfenv>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace surefoot {

/// While it lives, a result beyond the range of doubles is an infinity, and what can't be computed
/// of it NaN, without an exception: no trap that the caller has set, and no flag afterwards. For
/// what finds out whether numbers that are given from outside have squares.
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

  // Numbers that are read and written between two of them stay between them.
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

}  // namespace surefoot
