#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace surefoot::solver {

/// While alive, flushes results below the range of normal doubles (2e-308) to zero, and treats such
/// operands as zero, on processors with this mode. Orthogonal transformations of structured rows
/// shrink rounding errors into that range, where arithmetic is a hundred times slower.
class FlushDenormals {
 public:
  FlushDenormals() { write(saved_ | kFlushToZero | kDenormalsAreZero); }
  ~FlushDenormals() { write(saved_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  static constexpr unsigned kFlushToZero = 0x8000;
  static constexpr unsigned kDenormalsAreZero = 0x0040;

#if defined(__SSE2__)
  static unsigned read() { return _mm_getcsr(); }
  static void write(unsigned mode) { _mm_setcsr(mode); }
#else
  static unsigned read() { return 0; }
  static void write(unsigned) {}
#endif

  unsigned saved_ = read();
};

}  // namespace surefoot::solver
