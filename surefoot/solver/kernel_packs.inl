// The kernels of a sweep, for packs of SUREFOOT_PACK doubles. Included once for each instruction
// set, in its own namespace. Everything is static, and nothing of the standard library is used, so
// that the linker can't mix code for different processors.

constexpr int kPack = SUREFOOT_PACK;
#define SUREFOOT_INLINE static inline __attribute__((always_inline))

using Pack = double __attribute__((vector_size(8 * kPack), may_alias));
using LoosePack = double __attribute__((vector_size(8 * kPack), aligned(8), may_alias));
using Bits = long long __attribute__((vector_size(8 * kPack), may_alias));

SUREFOOT_INLINE Pack& at(double* p) { return *reinterpret_cast<Pack*>(p); }
SUREFOOT_INLINE const Pack& at(const double* p) { return *reinterpret_cast<const Pack*>(p); }
SUREFOOT_INLINE Pack loose(const double* p) { return *reinterpret_cast<const LoosePack*>(p); }
SUREFOOT_INLINE LoosePack& loosely(double* p) { return *reinterpret_cast<LoosePack*>(p); }
SUREFOOT_INLINE double absolute(double a) { return __builtin_fabs(a); }
SUREFOOT_INLINE double larger(double a, double b) { return a > b ? a : b; }
SUREFOOT_INLINE double smaller(double a, double b) { return a < b ? a : b; }
SUREFOOT_INLINE int padded(int n) { return (n + kPack - 1) / kPack * kPack; }

/// The sum of all elements, as a pack.
SUREFOOT_INLINE Pack sum(Pack p) {
#if SUREFOOT_PACK == 8
  using Half = double __attribute__((vector_size(32)));
  Half half = __builtin_shufflevector(p, p, 0, 1, 2, 3) + __builtin_shufflevector(p, p, 4, 5, 6, 7);
  half += __builtin_shufflevector(half, half, 2, 3, 0, 1);
  half += __builtin_shufflevector(half, half, 1, 0, 3, 2);
  return __builtin_shufflevector(half, half, 0, 1, 2, 3, 0, 1, 2, 3);
#elif SUREFOOT_PACK == 4
  p += __builtin_shufflevector(p, p, 2, 3, 0, 1);
  return p + __builtin_shufflevector(p, p, 1, 0, 3, 2);
#else
  return p + __builtin_shufflevector(p, p, 1, 0);
#endif
}

/// The index of each element.
#if SUREFOOT_PACK == 8
constexpr Bits kPlaces = {0, 1, 2, 3, 4, 5, 6, 7};
#elif SUREFOOT_PACK == 4
constexpr Bits kPlaces = {0, 1, 2, 3};
#else
constexpr Bits kPlaces = {0, 1};
#endif

/// Keeps the elements from position `first` on.
SUREFOOT_INLINE Pack from(Pack p, int first) {
  return (Pack)((Bits)p & (Bits)(kPlaces >= (long long)first));
}

/// p with the element at `place` replaced.
SUREFOOT_INLINE Pack with(Pack p, int place, double element) {
  return kPlaces == (long long)place ? Pack{} + element : p;
}

/// Element i is the sum of p[i], for as many packs as a pack has elements.
SUREFOOT_INLINE Pack sums(const Pack* p) {
#if SUREFOOT_PACK == 8
  Pack pairs[4], fours[2];
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i) {
    const Pack a = p[2 * i], b = p[2 * i + 1];
    pairs[i] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
               __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    const Pack a = pairs[2 * i], b = pairs[2 * i + 1];
    fours[i] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13) +
               __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  return __builtin_shufflevector(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15);
#elif SUREFOOT_PACK == 4
  Pack pairs[2];
#pragma GCC unroll 2
  for (int i = 0; i < 2; ++i) {
    const Pack a = p[2 * i], b = p[2 * i + 1];
    pairs[i] =
        __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  }
  return __builtin_shufflevector(pairs[0], pairs[1], 0, 1, 4, 5) +
         __builtin_shufflevector(pairs[0], pairs[1], 2, 3, 6, 7);
#else
  return __builtin_shufflevector(p[0], p[1], 0, 2) + __builtin_shufflevector(p[0], p[1], 1, 3);
#endif
}

SUREFOOT_INLINE double dot(const double* a, const double* b, int size) {
  Pack s = Pack{};
  for (int i = 0; i < size; i += kPack) s += at(a + i) * at(b + i);
  return sum(s)[0];
}

/// Dot product of unaligned vectors of any length.
SUREFOOT_INLINE double loose_dot(const double* a, const double* b, int size) {
  if (size < kPack) {
    double s = 0.0;
    for (int i = 0; i < size; ++i) s += a[i] * b[i];
    return s;
  }
  Pack s = Pack{};
  int i = 0;
  for (; i + kPack <= size; i += kPack) s += loose(a + i) * loose(b + i);
  // The last pack ends with the vectors; drop what was counted.
  const int last = size - kPack;
  const Pack rest = from(loose(a + last) * loose(b + last), i - last);
  return sum(s + rest)[0];
}

/// rows ← rows (I − β v vᵀ), for vectors of N packs; 0: any number.
template <int N>
static void reflect_packs(double* rows, int stride, const int* list, int count, const double* v,
                          double beta, int packs) {
  if constexpr (N > 0) {
    Pack held[N];
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) held[k] = at(v + k * kPack);
    for (int i = 0; i < count; ++i) {
      double* row = rows + (long)list[i] * stride;
      Pack here[N];
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) here[k] = at(row + k * kPack);
      Pack along = here[0] * held[0];
#pragma GCC unroll 4
      for (int k = 1; k < N; ++k) along += here[k] * held[k];
      along = sum(along) * beta;
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) at(row + k * kPack) = here[k] - along * held[k];
    }
  } else {
    int i = 0;
    for (; i + 4 <= count; i += 4) {  // four rows share one reading of v
      double* row[4];
      Pack chain[4] = {};
#pragma GCC unroll 4
      for (int r = 0; r < 4; ++r) row[r] = rows + (long)list[i + r] * stride;
      for (int k = 0; k < packs * kPack; k += kPack) {
        const Pack here = at(v + k);
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r) chain[r] += at(row[r] + k) * here;
      }
#pragma GCC unroll 4
      for (int r = 0; r < 4; ++r) chain[r] = sum(chain[r]) * beta;
      for (int k = 0; k < packs * kPack; k += kPack) {
        const Pack here = at(v + k);
#pragma GCC unroll 4
        for (int r = 0; r < 4; ++r) at(row[r] + k) -= chain[r] * here;
      }
    }
    for (; i < count; ++i) {
      double* row = rows + (long)list[i] * stride;
      Pack chain[4] = {};  // four independent sums
      int k = 0;
      for (; k + 4 <= packs; k += 4) {
#pragma GCC unroll 4
        for (int c = 0; c < 4; ++c) {
          chain[c] += at(row + (k + c) * kPack) * at(v + (k + c) * kPack);
        }
      }
      for (; k < packs; ++k) chain[0] += at(row + k * kPack) * at(v + k * kPack);
      const Pack along = sum((chain[0] + chain[1]) + (chain[2] + chain[3])) * beta;
      for (k = 0; k < packs; ++k) at(row + k * kPack) -= along * at(v + k * kPack);
    }
  }
}

/// The same for the columns from `first` on, where v begins.
static void reflect(double* rows, int stride, const int* list, int count, const double* v,
                    double beta, int first) {
  const int skip = first / kPack * kPack;
  const int packs = (stride - skip) / kPack;
  rows += skip;
  v += skip;
  switch (packs) {
    case 1:
      return reflect_packs<1>(rows, stride, list, count, v, beta, 1);
    case 2:
      return reflect_packs<2>(rows, stride, list, count, v, beta, 2);
    case 3:
      return reflect_packs<3>(rows, stride, list, count, v, beta, 3);
    case 4:
      return reflect_packs<4>(rows, stride, list, count, v, beta, 4);
    default:
      return reflect_packs<0>(rows, stride, list, count, v, beta, packs);
  }
}

/// Squared length of a row in the columns from `first` on.
SUREFOOT_INLINE double square_from(const double* row, int first, int stride) {
  int k = first / kPack * kPack;
  const Pack head = from(at(row + k), first - k);
  Pack s = head * head;
  for (k += kPack; k < stride; k += kPack) s += at(row + k) * at(row + k);
  return sum(s)[0];
}

/// Turns `row` into (…, head, 0, …) by a reflection in the columns from `first` on. Returns β.
SUREFOOT_INLINE double make_reflection(double* row, double* v, int first, int stride, double square,
                                       double& head) {
  const double norm = __builtin_sqrt(square);
  const double here = row[first];
  head = here > 0.0 ? -norm : norm;
  int k = first / kPack * kPack;
  const Pack tail = from(at(row + k), first - k);
  at(v + k) = with(tail, first - k, here - head);
  at(row + k) = with(at(row + k) - tail, first - k, head);
  for (k += kPack; k < stride; k += kPack) {
    at(v + k) = at(row + k);
    at(row + k) = Pack{};
  }
  return 1.0 / (square + norm * absolute(here));
}

static void swap_rows(int* order, int i, int j) {
  const int row = order[i];
  order[i] = order[j];
  order[j] = row;
}
