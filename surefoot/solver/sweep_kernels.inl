// The kernels of a sweep, for packs of SUREFOOT_PACK doubles. Included once for each instruction
// set, in a namespace of its own; everything is static, so that no code for one processor can be
// linked into the code for another. For the same reason nothing of the standard library is used.

constexpr int kPack = SUREFOOT_PACK;
#define SUREFOOT_INLINE static inline __attribute__((always_inline))

using Pack = double __attribute__((vector_size(8 * kPack), may_alias));
using LoosePack = double __attribute__((vector_size(8 * kPack), aligned(8), may_alias));
using Bits = long long __attribute__((vector_size(8 * kPack), may_alias));

SUREFOOT_INLINE Pack& at(double* p) { return *reinterpret_cast<Pack*>(p); }
SUREFOOT_INLINE const Pack& at(const double* p) { return *reinterpret_cast<const Pack*>(p); }
SUREFOOT_INLINE Pack loose(const double* p) { return *reinterpret_cast<const LoosePack*>(p); }
SUREFOOT_INLINE double absolute(double a) { return __builtin_fabs(a); }
SUREFOOT_INLINE double larger(double a, double b) { return a > b ? a : b; }
SUREFOOT_INLINE double smaller(double a, double b) { return a < b ? a : b; }
SUREFOOT_INLINE int padded(int n) { return (n + kPack - 1) / kPack * kPack; }

/// The sum of all elements, in all elements.
SUREFOOT_INLINE Pack sum(Pack p) {
#if SUREFOOT_PACK == 8
  p += __builtin_shufflevector(p, p, 4, 5, 6, 7, 0, 1, 2, 3);
  p += __builtin_shufflevector(p, p, 2, 3, 0, 1, 6, 7, 4, 5);
  return p + __builtin_shufflevector(p, p, 1, 0, 3, 2, 5, 4, 7, 6);
#elif SUREFOOT_PACK == 4
  p += __builtin_shufflevector(p, p, 2, 3, 0, 1);
  return p + __builtin_shufflevector(p, p, 1, 0, 3, 2);
#else
  return p + __builtin_shufflevector(p, p, 1, 0);
#endif
}

/// Keeps the elements from position `first` on.
SUREFOOT_INLINE Pack from(Pack p, int first) {
#if SUREFOOT_PACK == 8
  const Bits position = {0, 1, 2, 3, 4, 5, 6, 7};
#elif SUREFOOT_PACK == 4
  const Bits position = {0, 1, 2, 3};
#else
  const Bits position = {0, 1};
#endif
  return (Pack)((Bits)p & (Bits)(position >= (long long)first));
}

/// p with the element at `place` replaced.
SUREFOOT_INLINE Pack with(Pack p, int place, double element) {
#if SUREFOOT_PACK == 8
  const Bits position = {0, 1, 2, 3, 4, 5, 6, 7};
#elif SUREFOOT_PACK == 4
  const Bits position = {0, 1, 2, 3};
#else
  const Bits position = {0, 1};
#endif
  return position == (long long)place ? Pack{} + element : p;
}

SUREFOOT_INLINE double dot(const double* a, const double* b, int size) {
  Pack s = Pack{};
  for (int i = 0; i < size; i += kPack) s += at(a + i) * at(b + i);
  return sum(s)[0];
}

/// Unaligned vectors of any length.
SUREFOOT_INLINE double loose_dot(const double* a, const double* b, int size) {
  if (size < kPack) {
    double s = 0.0;
    for (int i = 0; i < size; ++i) s += a[i] * b[i];
    return s;
  }
  Pack s = Pack{};
  int i = 0;
  for (; i + kPack <= size; i += kPack) s += loose(a + i) * loose(b + i);
  // The rest again ends where the vectors end; what has been counted is left out.
  const int last = size - kPack;
  const Pack rest = from(loose(a + last) * loose(b + last), i - last);
  return sum(s + rest)[0];
}

void measure(Sweep& s) {
  for (int i = 0; i < s.num_rows; ++i) {
    s.scale[i] = __builtin_sqrt(loose_dot(s.a[i], s.a[i], s.unknowns));
  }
}

void evaluate(Sweep& s, int first, int end) {
  for (int i = first; i < end; ++i) s.value[i] = loose_dot(s.a[i], s.x, s.unknowns);
}

/// rows ← rows (I − β v vᵀ), for vectors of N packs; N = 0: of any number.
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
    for (int i = 0; i < count; ++i) {
      double* row = rows + (long)list[i] * stride;
      Pack along = Pack{};
      for (int k = 0; k < packs; ++k) along += at(row + k * kPack) * at(v + k * kPack);
      along = sum(along) * beta;
      for (int k = 0; k < packs; ++k) at(row + k * kPack) -= along * at(v + k * kPack);
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

/// What a difference of squares keeps at least, to be as good as a sum.
constexpr double kWellLeft = 0.25;

/// The row at `position` takes the next column; in all rows after it the basis turns. Returns the
/// squared length that is left of the next row. The elimination of that row waits for it: so its
/// products with this row come first, which need no root and no division. N packs; 0: any number.
template <int N>
static double eliminate_packs(Sweep& s, int position, int column, double square) {
  const int skip = column / kPack * kPack;
  const int packs = N > 0 ? N : (s.stride - skip) / kPack;
  double* row = s.rows + (long)s.order[position] * s.stride + skip;
  double* v = s.reflectors + (long)column * s.stride + skip;
  const int place = column - skip;
  const int* after = s.order + position + 1;
  const int count = s.num_taking_part - position - 1;
  const bool has_next = count > 0 && s.fixed < s.columns;
  double* next = has_next ? s.rows + (long)*after * s.stride + skip : row;

  Pack product = Pack{}, next_square = Pack{};
#pragma GCC unroll 4
  for (int k = 0; k < packs; ++k) {
    const Pack here = k == 0 ? from(at(row), place) : at(row + k * kPack);
    const Pack there = k == 0 ? from(at(next), place) : at(next + k * kPack);
    product += here * there;
    next_square += there * there;
  }
  const double first = row[place], next_first = next[place];
  const double norm = __builtin_sqrt(square);
  const double head = first > 0.0 ? -norm : norm;
  const double beta = 1.0 / (square + norm * absolute(first));
  const double along = (sum(product)[0] - head * next_first) * beta;
#pragma GCC unroll 4
  for (int k = 0; k < packs; ++k) {
    const Pack tail = k == 0 ? from(at(row), place) : at(row + k * kPack);
    const Pack reflector = k == 0 ? with(tail, place, first - head) : tail;
    at(v + k * kPack) = reflector;
    at(row + k * kPack) = k == 0 ? with(at(row) - tail, place, head) : Pack{};
    if (has_next) at(next + k * kPack) -= along * reflector;
  }
  s.beta[column] = beta;
  s.inverse_pivot[column] = 1.0 / head;
  if (!has_next) {
    reflect_packs<N>(s.rows + skip, s.stride, after, count, v, beta, packs);
    return 0.0;
  }
  const double next_head = next_first - along * (first - head);
  const double all = sum(next_square)[0];
  const double left = all - next_head * next_head;
  reflect_packs<N>(s.rows + skip, s.stride, after + 1, count - 1, v, beta, packs);
  if (left > kWellLeft * all) return left;
  return square_from(next - skip, s.fixed, s.stride);
}

static double eliminate(Sweep& s, int position, double square, bool usable) {
  const int column = s.fixed++;
  s.pivot[column] = usable ? s.order[position] : -1;
  double left = 0.0;
  switch ((s.stride - column / kPack * kPack) / kPack) {
    case 1:
      left = eliminate_packs<1>(s, position, column, square);
      break;
    case 2:
      left = eliminate_packs<2>(s, position, column, square);
      break;
    case 3:
      left = eliminate_packs<3>(s, position, column, square);
      break;
    case 4:
      left = eliminate_packs<4>(s, position, column, square);
      break;
    default:
      left = eliminate_packs<0>(s, position, column, square);
  }
  if (!usable) s.inverse_pivot[column] = 0.0;
  return left;
}

/// Rows that keep this share of their length are used as they come, in any order.
constexpr double kClearlyIndependent = 0.1;

/// Gives columns to the rows of a level; those that get one come first, last among them the rows
/// whose column is too weak to be used. Returns how many can use theirs.
static int factorize_level(Sweep& s, int begin, int end) {
  int next = begin;
  int num_weak = 0;
  int untried = end;
  double square = -1.0;  // of the next row; negative: not known
  while (next < untried && s.fixed < s.columns) {
    const int row = s.order[next];
    if (square < 0.0) square = square_from(s.rows + (long)row * s.stride, s.fixed, s.stride);
    const double clearly = kClearlyIndependent * s.scale[row];
    if (square > clearly * clearly) {
      if (square < s.smallest_pivot * s.smallest_pivot * s.scale[row] * s.scale[row]) {
        s.smallest_pivot = __builtin_sqrt(square) / s.scale[row];
      }
      square = eliminate(s, next++, square, true);
    } else {
      swap_rows(s.order, next, --untried);
      square = -1.0;
    }
  }
  while (next < end && s.fixed < s.columns) {  // the rest: the longest first
    int best = -1;
    double best_square = 0.0, best_relative = s.keep_tolerance;
    for (int i = next; i < end; ++i) {
      const int row = s.order[i];
      const double left = square_from(s.rows + (long)row * s.stride, s.fixed, s.stride);
      const double relative = s.scale[row] > 0.0 ? __builtin_sqrt(left) / s.scale[row] : 0.0;
      if (!(relative > best_relative)) continue;
      best = i;
      best_square = left;
      best_relative = relative;
    }
    if (best < 0) break;
    swap_rows(s.order, next, best);
    const bool usable = best_relative > s.solve_tolerance;
    if (usable) s.smallest_pivot = smaller(s.smallest_pivot, best_relative);
    num_weak += usable ? 0 : 1;
    (void)eliminate(s, next++, best_square, usable);
  }
  return next - begin - num_weak;
}

SUREFOOT_INLINE double bound(const Sweep& s, int row) {
  return s.side[row] < 0 ? s.lower[row] : s.upper[row];
}

static void update_residuals(Sweep& s, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const int row = s.order[i];
    s.residual[row] =
        dot(s.rows + (long)row * s.stride, s.q, s.stride) + s.base_value[row] - bound(s, row);
  }
}

/// L q = −residual by forward substitution, for the rows that have a column; all residuals follow.
static void substitute(Sweep& s, int begin, int end, int first_column) {
  for (int i = begin, column = first_column; column < s.fixed; ++i, ++column) {
    const double q = -s.residual[s.order[i]] * s.inverse_pivot[column];
    s.q[column] = q;
    if (q == 0.0) continue;
    for (int k = i; k < end; ++k) {
      const int row = s.order[k];
      s.residual[row] += q * s.rows[(long)row * s.stride + column];
    }
  }
}

/// Rounding of a row's value, relative to ‖a‖ ‖x‖.
constexpr double kRounding = 1e-14;

static bool is_met(const Sweep& s, int begin, int end) {
  const double size = __builtin_sqrt(dot(s.q, s.q, s.stride));
  for (int i = begin; i < end; ++i) {
    const int row = s.order[i];
    if (absolute(s.residual[row]) > kRounding * s.scale[row] * size) return false;
  }
  return true;
}

/// `tall` ← [columns of a level's rows | −residual], for rows [begin, end) of the order.
static void fill_tall(Sweep& s, int begin, int end, const int* columns, int num_columns) {
  s.tall_stride = padded(end - begin);
  for (int j = 0; j <= num_columns; ++j) {
    double* column = s.tall + (long)j * s.tall_stride;
    for (int i = begin; i < end; ++i) {
      const int row = s.order[i];
      column[i - begin] =
          j < num_columns ? s.rows[(long)row * s.stride + columns[j]] : -s.residual[row];
    }
    for (int i = end - begin; i < s.tall_stride; ++i) column[i] = 0.0;
  }
}

/// Least squares of more rows than columns by column reflections. Stable for rows whose scales
/// differ: the longest column and its largest element come first (Powell and Reid 1969). q of
/// `columns` is set.
static void solve_tall(Sweep& s, int num_rows, int* columns, int num_columns) {
  const int stride = s.tall_stride;
  double* rhs = s.tall + (long)num_columns * stride;
  for (int j = 0; j <= num_columns; ++j) s.tall_order[j] = j;
  for (int j = 0; j < num_columns; ++j) {
    int best = j;
    double longest = -1.0;
    for (int k = j; k < num_columns; ++k) {
      const double square = square_from(s.tall + (long)s.tall_order[k] * stride, j, stride);
      if (square > longest) {
        longest = square;
        best = k;
      }
    }
    swap_rows(s.tall_order, j, best);
    swap_rows(columns, j, best);
    double* column = s.tall + (long)s.tall_order[j] * stride;
    int top = j;
    for (int i = j; i < num_rows; ++i) top = absolute(column[i]) > absolute(column[top]) ? i : top;
    for (int k = 0; k <= num_columns; ++k) {
      double* other = s.tall + (long)k * stride;
      const double up = other[top];
      other[top] = other[j];
      other[j] = up;
    }
    if (!(longest > 0.0)) continue;
    double head = 0.0;
    const double beta = make_reflection(column, s.gradient, j, stride, longest, head);
    reflect(s.tall, stride, s.tall_order + j + 1, num_columns - j, s.gradient, beta, j);
  }
  for (int j = num_columns - 1; j >= 0; --j) {
    double left = rhs[j];
    for (int k = j + 1; k < num_columns; ++k) {
      left -= s.tall[(long)s.tall_order[k] * stride + j] * s.q[columns[k]];
    }
    const double pivot = s.tall[(long)s.tall_order[j] * stride + j];
    s.q[columns[j]] = pivot != 0.0 ? left / pivot : 0.0;
  }
}

/// Columns of a last level are clearly independent if none is shorter than this share of the
/// longest after projection, for rows of scales that differ by less than kSimilar.
constexpr double kFullRank = 1e-4;
constexpr double kSimilar = 1e3;

/// A last level of equalities, with at least as many rows as free columns: takes all columns at
/// once and needs no factorization from the right. False where their rank isn't clear.
static bool solve_last(Sweep& s, int begin, int end) {
  const int free = s.columns - s.fixed;
  const int num_rows = end - begin;
  if (end != s.num_taking_part || free == 0 || num_rows < free) return false;
  double least = s.scale[s.order[begin]], most = least;
  for (int i = begin; i < end; ++i) {
    if (s.side[s.order[i]] != 2) return false;
    least = smaller(least, s.scale[s.order[i]]);
    most = larger(most, s.scale[s.order[i]]);
  }
  if (!(most < kSimilar * least)) return false;
  int* columns = s.pivot + s.fixed;
  for (int j = 0; j < free; ++j) columns[j] = s.fixed + j;
  fill_tall(s, begin, end, columns, free);
  double* rhs = s.tall + (long)free * s.tall_stride;
  double shortest = 1e300, longest = 0.0;
  for (int j = 0; j <= free; ++j) s.tall_order[j] = j;
  for (int j = 0; j < free; ++j) {
    double* column = s.tall + (long)j * s.tall_stride;
    const double square = square_from(column, j, s.tall_stride);
    shortest = smaller(shortest, square);
    longest = larger(longest, square);
    if (!(shortest > kFullRank * kFullRank * longest)) return false;
    double head = 0.0;
    const double beta = make_reflection(column, s.gradient, j, s.tall_stride, square, head);
    reflect(s.tall, s.tall_stride, s.tall_order + j + 1, free - j, s.gradient, beta, j);
  }
  if (!(shortest > kFullRank * kFullRank * most * most)) return false;
  for (int j = free - 1; j >= 0; --j) {
    const double q = rhs[j] / s.tall[(long)j * s.tall_stride + j];
    s.q[s.fixed + j] = q;
    for (int i = 0; i < j; ++i) rhs[i] -= q * s.tall[(long)j * s.tall_stride + i];
  }
  for (int j = 0; j < free; ++j) {
    s.pivot[s.fixed + j] = -1;
    s.inverse_pivot[s.fixed + j] = 0.0;
    s.beta[s.fixed + j] = 0.0;
  }
  s.fixed = s.columns;
  return true;
}

constexpr double kEpsilon = 2.220446049250313e-16;

/// What is taken for rounding at most, however weak the columns used.
constexpr double kMostRounding = 1e-4;

/// The weaker the columns used, the larger the rounding in what is left.
static void lower_rank_tolerance(Sweep& s) {
  const double rounding = 64.0 * kEpsilon / s.smallest_pivot;
  s.keep_tolerance = larger(s.keep_tolerance, smaller(rounding, kMostRounding));
}

static void run_level(Sweep& s, int begin, int end) {
  update_residuals(s, begin, end);
  if (begin == end || s.fixed == s.columns) return;
  if (solve_last(s, begin, end)) return update_residuals(s, begin, end);
  const int first = s.fixed;
  const int num_used = factorize_level(s, begin, end);
  substitute(s, begin, end, first);
  if (begin + num_used < end && !is_met(s, begin + num_used, end)) {
    int* columns = s.tall_order + s.columns + 1;
    int num_columns = 0;
    for (int j = first; j < s.fixed; ++j) {
      if (s.pivot[j] >= 0) columns[num_columns++] = j;
      s.q[j] = 0.0;
    }
    update_residuals(s, begin, end);
    fill_tall(s, begin, end, columns, num_columns);
    solve_tall(s, end - begin, columns, num_columns);
    update_residuals(s, begin, end);
  }
  lower_rank_tolerance(s);
}

void start(Sweep& s, int first, int end) {
  s.num_taking_part = 0;
  for (int k = first; k < end; ++k) {
    s.order_begin[k] = s.num_taking_part;
    for (int row = s.level_begin[k]; row < s.level_begin[k + 1]; ++row) {
      if (s.side[row] != 0) s.order[s.num_taking_part++] = row;
    }
  }
  s.order_begin[end] = s.num_taking_part;
  s.fixed = 0;
  for (int j = 0; j < s.stride; j += kPack) at(s.q + j) = Pack{};
  for (int i = 0; i < s.num_taking_part; ++i) {
    const double* from_row = s.base + (long)s.order[i] * s.stride;
    double* to_row = s.rows + (long)s.order[i] * s.stride;
    for (int j = 0; j < s.stride; j += kPack) at(to_row + j) = at(from_row + j);
  }
}

void start_leading(Sweep& s, int end) {
  s.num_taking_part = s.level_begin[end];
  for (int k = 0; k <= end; ++k) s.order_begin[k] = s.level_begin[k];
  s.fixed = 0;
  for (int j = 0; j < s.stride; j += kPack) at(s.q + j) = Pack{};
  const int whole = s.unknowns / kPack * kPack;
  for (int row = 0; row < s.num_taking_part; ++row) {
    s.order[row] = row;
    s.base_value[row] = 0.0;
    double* to = s.rows + (long)row * s.stride;
    for (int j = 0; j < whole; j += kPack) at(to + j) = loose(s.a[row] + j);
    if (whole == s.stride) continue;
    at(to + whole) = Pack{};
    for (int j = whole; j < s.unknowns; ++j) to[j] = s.a[row][j];
  }
}

void fix(Sweep& s, int begin, int end) {
  (void)factorize_level(s, begin, end);
  lower_rank_tolerance(s);
}

void run(Sweep& s, int first, int end) {
  for (int k = first; k < end; ++k) {
    s.first_column[k] = s.fixed;
    run_level(s, s.order_begin[k], s.order_begin[k + 1]);
  }
  s.first_column[end] = s.fixed;
}

/// Σ aᵢ basis(i, :) over [first, end), for N packs from `from` on. Two rows in turn, so that sums
/// don't wait for each other.
template <int N>
SUREFOOT_INLINE void sum_rows(const double* a, const double* basis, int stride, int first, int end,
                              Pack* result) {
  constexpr int kChains = N > 2 ? 2 : 4;
  Pack chain[kChains][N] = {};
  int i = first;
  for (; i + kChains <= end; i += kChains) {
    const double* row = basis + (long)i * stride;
#pragma GCC unroll 4
    for (int c = 0; c < kChains; ++c) {
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) chain[c][k] += a[i + c] * at(row + c * stride + k * kPack);
    }
  }
  for (; i < end; ++i) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      chain[0][k] += a[i] * at(basis + (long)i * stride + k * kPack);
    }
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    result[k] = chain[0][k] + chain[1][k];
    if constexpr (kChains == 4) result[k] += chain[2][k] + chain[3][k];
  }
}

/// rows of `basis` from `first` on ← (I − β v vᵀ) rows, for rows of N packs; N = 0: of any number.
template <int N>
static void reflect_basis(Sweep& s, int stride, const double* v, double beta, int first) {
  constexpr int kWidth = N > 0 ? N : 1;
  const int packs = N > 0 ? N : stride / kPack;
  for (int p = 0; p < packs; p += kWidth) {
    double* basis = s.basis + p * kPack;
    Pack along[kWidth];
    sum_rows<kWidth>(v, basis, stride, first, s.unknowns, along);
#pragma GCC unroll 4
    for (int k = 0; k < kWidth; ++k) along[k] *= beta;
    for (int i = first; i < s.unknowns; ++i) {
      double* row = basis + (long)i * stride;
#pragma GCC unroll 4
      for (int k = 0; k < kWidth; ++k) at(row + k * kPack) -= v[i] * along[k];
    }
  }
}

void reduce(Sweep& s) {
  const int fixed = s.fixed;
  const int columns = s.columns - fixed;
  const int stride = padded(columns + 1);
  for (int i = 0; i < s.unknowns; ++i) {
    double* row = s.basis + (long)i * stride;
    for (int j = 0; j < stride; j += kPack) at(row + j) = Pack{};
    if (i < fixed) row[columns] = s.q[i];
    if (i >= fixed) row[i - fixed] = 1.0;
  }
  for (int j = fixed - 1; j >= 0; --j) {
    const double* v = s.reflectors + (long)j * s.stride;
    switch (stride / kPack) {
      case 1:
        reflect_basis<1>(s, stride, v, s.beta[j], j);
        break;
      case 2:
        reflect_basis<2>(s, stride, v, s.beta[j], j);
        break;
      case 4:
        reflect_basis<4>(s, stride, v, s.beta[j], j);
        break;
      default:
        reflect_basis<0>(s, stride, v, s.beta[j], j);
    }
  }
  s.columns = columns;
  s.stride = stride;
  s.fixed = 0;
}

/// to ← Σ aᵢ basis(i, :), for rows of N packs; N = 0: of any number.
template <int N>
static void combine(const Sweep& s, const double* a, int first, int end, double* to) {
  constexpr int kWidth = N > 0 ? N : 1;
  const int packs = N > 0 ? N : s.stride / kPack;
  for (int p = 0; p < packs; p += kWidth) {
    Pack total[kWidth];
    sum_rows<kWidth>(a, s.basis + p * kPack, s.stride, first, end, total);
#pragma GCC unroll 4
    for (int k = 0; k < kWidth; ++k) at(to + (p + k) * kPack) = total[k];
  }
}

void project(Sweep& s, int row) {
  const double* a = s.a[row];
  double* to = s.base + (long)row * s.stride;
  s.base_value[row] = 0.0;
  if (s.columns == s.unknowns) {  // the basis is the identity
    for (int j = 0; j < s.columns; ++j) to[j] = a[j];
    for (int j = s.columns; j < s.stride; ++j) to[j] = 0.0;
    return;
  }
  int first = 0, end = s.unknowns;
  while (end > 0 && a[end - 1] == 0.0) --end;
  while (first < end && a[first] == 0.0) ++first;
  switch (s.stride / kPack) {
    case 2:
      combine<2>(s, a, first, end, to);
      break;
    case 4:
      combine<4>(s, a, first, end, to);
      break;
    default:
      combine<0>(s, a, first, end, to);
  }
  s.base_value[row] = to[s.columns];
  to[s.columns] = 0.0;
}

void turn_back(Sweep& s, int first) {
  for (int j = 0; j < s.stride; j += kPack) at(s.y + j) = at(s.q + j);
  const int self = 0;
  for (int j = s.fixed - 1; j >= first; --j) {
    if (s.beta[j] != 0.0) {
      reflect(s.y, s.stride, &self, 1, s.reflectors + (long)j * s.stride, s.beta[j], j);
    }
  }
}

void recover(Sweep& s) {
  if (s.columns == s.unknowns) {
    for (int i = 0; i < s.unknowns; ++i) s.x[i] = s.y[i];
    return;
  }
  s.y[s.columns] = 1.0;
  for (int i = 0; i < s.unknowns; ++i) {
    s.x[i] = dot(s.basis + (long)i * s.stride, s.y, s.stride);
  }
}

/// Lᵀ force = −gradient by back substitution over the columns [last, first).
static void balance_gradient(Sweep& s, int first, int last) {
  for (int j = first - 1; j >= last; --j) {
    const int row = s.pivot[j];
    if (row < 0) continue;  // no row has this column: whatever pulls along it meets no resistance
    const double force = -s.gradient[j] * s.inverse_pivot[j];
    s.force[row] = force;
    if (force == 0.0) continue;
    const double* from_row = s.rows + (long)row * s.stride;
    for (int k = last / kPack * kPack; k <= j; k += kPack) {
      at(s.gradient + k) += force * at(from_row + k);
    }
  }
}

void balance(Sweep& s, int level, int last) {
  const int first = s.first_column[level];
  for (int j = 0; j < s.stride; j += kPack) at(s.gradient + j) = Pack{};
  for (int i = s.order_begin[level]; i < s.order_begin[level + 1]; ++i) {
    const int row = s.order[i];
    const double* from_row = s.rows + (long)row * s.stride;
    for (int j = 0; j < first; j += kPack) at(s.gradient + j) += s.residual[row] * at(from_row + j);
  }
  balance_gradient(s, first, last);
}

void balance_norm(Sweep& s, int last) {
  for (int j = 0; j < s.stride; j += kPack) at(s.gradient + j) = at(s.q + j);
  balance_gradient(s, s.fixed, last);
}
