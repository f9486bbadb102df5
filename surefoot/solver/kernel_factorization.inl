// Factorizes level by level: reflections give each active row a column.

/// Smallest share that a difference of squares keeps, to be as accurate as a sum.
constexpr double kMinDifference = 0.25;

/// Gives the row at `position` the next column, and turns the basis in all rows after it. Returns
/// the squared length left of the next row, whose elimination waits for it: its products with this
/// row come first, without root and division. N packs; 0: any number. All rows so far are zero from
/// `width` on, and only the part before it is processed.
template <int N>
static double eliminate_packs(Sweep& s, int position, int column, double square, int width) {
  const int skip = column / kPack * kPack;
  const int packs = N > 0 ? N : (width - skip) / kPack;
  double* row = s.rows + (long)s.order[position] * s.stride + skip;
  double* v = s.reflectors + (long)column * s.stride + skip;
  const int place = column - skip;
  const int* after = s.order + position + 1;
  const int count = s.turned_end - position - 1;
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
  if (left > kMinDifference * all) return left;
  return square_from(next - skip, s.fixed, s.stride);
}

static double eliminate(Sweep& s, int position, double square, bool usable, int width) {
  const int column = s.fixed++;
  s.pivot[column] = usable ? s.order[position] : -1;
  double left = 0.0;
  switch ((width - column / kPack * kPack) / kPack) {
    case 1:
      left = eliminate_packs<1>(s, position, column, square, width);
      break;
    case 2:
      left = eliminate_packs<2>(s, position, column, square, width);
      break;
    case 3:
      left = eliminate_packs<3>(s, position, column, square, width);
      break;
    case 4:
      left = eliminate_packs<4>(s, position, column, square, width);
      break;
    default:
      left = eliminate_packs<0>(s, position, column, square, width);
  }
  if (!usable) s.inverse_pivot[column] = 0.0;
  return left;
}

/// Rows that keep this share of their length are used in any order.
constexpr double kClearlyIndependent = 0.1;

/// Gives columns to the rows of a level. Rows with a column move to the front, those with a column
/// too weak to use last among them. Returns the number of usable columns.
static int factorize_level(Sweep& s, int begin, int end) {
  int next = begin;
  int num_weak = 0;
  int untried = end;
  double square = -1.0;  // of the next row; negative: unknown
  while (next < untried && s.fixed < s.columns) {
    const int row = s.order[next];
    if (square < 0.0) square = square_from(s.rows + (long)row * s.stride, s.fixed, s.stride);
    const double clearly = kClearlyIndependent * s.scale[row];
    if (square > clearly * clearly) {
      if (square < s.smallest_pivot * s.smallest_pivot * s.scale[row] * s.scale[row]) {
        s.smallest_pivot = __builtin_sqrt(square) / s.scale[row];
      }
      square = eliminate(s, next++, square, true, s.stride);
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
    double& smallest = usable ? s.smallest_pivot : s.unused_pivot;
    smallest = smaller(smallest, best_relative);
    num_weak += usable ? 0 : 1;
    (void)eliminate(s, next++, best_square, usable, s.stride);
  }
  return next - begin - num_weak;
}

SUREFOOT_INLINE double bound(const Sweep& s, int row) {
  return s.side[row] < 0 ? s.lower[row] : s.upper[row];
}

static void update_residuals(Sweep& s, int begin, int end) {
  for (int i = begin; i < end; ++i) {
    const int row = s.order[i];
    const double at_zero = s.base_value[row] - bound(s, row);
    s.residual[row] =
        s.fixed == 0 ? at_zero : at_zero + dot(s.rows + (long)row * s.stride, s.q, s.stride);
  }
}

/// L q = −residual by forward substitution for rows with a column; updates all residuals.
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

static bool is_met(const Sweep& s, int begin, int end) {
  const double size = __builtin_sqrt(dot(s.q, s.q, s.stride));
  for (int i = begin; i < end; ++i) {
    const int row = s.order[i];
    if (absolute(s.residual[row]) > tolerance::kRounding * s.scale[row] * size) return false;
  }
  return true;
}

#include "surefoot/solver/kernel_least_squares.inl"

/// Weaker pivots leave more rounding in the other rows.
static void lower_rank_tolerance(Sweep& s) {
  s.keep_tolerance = larger(s.keep_tolerance, tolerance::rounding_after(s.smallest_pivot));
}

/// Elements of rows that are turned as soon as a reflection exists. Other rows wait for their
/// level, so that turned rows stay in the nearest cache.
constexpr int kNearElements = 3072;

/// Applies the reflections so far to the next levels from `level` on.
static void turn_next_levels(Sweep& s, int level, int end_level) {
  const int begin = s.turned_end;
  if (s.order_begin[level + 1] <= begin) return;
  int end = s.order_begin[level + 1];
  for (int k = level + 1;
       k < end_level && (s.order_begin[k + 1] - begin) * s.stride <= kNearElements; ++k) {
    end = s.order_begin[k + 1];
  }
  for (int column = s.first_reflection; column < s.fixed; ++column) {
    if (s.beta[column] == 0.0) continue;
    reflect(s.rows, s.stride, s.order + begin, end - begin, s.reflectors + (long)column * s.stride,
            s.beta[column], column);
  }
  s.turned_end = end;
}

static void run_level(Sweep& s, int level) {
  const int begin = s.order_begin[level], end = s.order_begin[level + 1];
  update_residuals(s, begin, end);
  if (begin == end || s.fixed == s.columns) return;
  if (solve_last(s, begin, end)) {
    s.solved_last = level;
    return update_residuals(s, begin, end);
  }
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

/// Copies a row, for an identity basis.
SUREFOOT_INLINE void copy_row(Sweep& s, int row) {
  const int whole = s.unknowns / kPack * kPack;
  const double* a = s.a[row];
  double* to = s.rows + (long)row * s.stride;
  for (int j = 0; j < whole; j += kPack) at(to + j) = loose(a + j);
  if (whole == s.stride) return;
  if (whole == 0) {
    at(to) = Pack{};
    for (int j = 0; j < s.unknowns; ++j) to[j] = a[j];
    return;
  }
  const int last = s.unknowns - kPack;  // the last pack ends with the row and overlaps
  at(to + whole) = Pack{};
  loosely(to + last) = loose(a + last);
}

/// Begins a factorization of whole rows.
static void begin_factorization(Sweep& s) {
  s.fixed = s.first_reflection = s.turned_end = 0;
  s.solved_last = -1;
  for (int j = 0; j < s.stride; j += kPack) at(s.q + j) = Pack{};
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
  begin_factorization(s);
  for (int i = 0; i < s.num_taking_part; ++i) {
    const int row = s.order[i];
    if (s.is_identity()) {
      copy_row(s, row);
      continue;
    }
    const double* from_row = s.base + (long)row * s.stride;
    double* to_row = s.rows + (long)row * s.stride;
    for (int j = 0; j < s.stride; j += kPack) at(to_row + j) = at(from_row + j);
  }
}

void start_leading(Sweep& s, int end) {
  s.num_taking_part = s.level_begin[end];
  for (int k = 0; k <= end; ++k) s.order_begin[k] = s.level_begin[k];
  begin_factorization(s);
  for (int row = 0; row < s.num_taking_part; ++row) {
    s.order[row] = row;
    s.base_value[row] = 0.0;
    copy_row(s, row);
  }
  for (int column = 0; column < s.unknowns; ++column) s.reach[column] = s.unknowns;
}

/// order ← rows of the levels before `end`, by the place of their last coefficient; `list` ← these
/// places. Goes backwards over levels: physics has its short rows in the second.
static void order_by_end(Sweep& s, int end) {
  int count = 0;
  for (int k = end - 1; k >= 0; --k) {
    for (int row = s.level_begin[k]; row < s.level_begin[k + 1]; ++row) {
      int size = s.unknowns;
      while (size > 0 && s.a[row][size - 1] == 0.0) --size;
      s.list[row] = size;
      int place = count++;
      for (; place > 0 && s.list[s.order[place - 1]] > size; --place) {
        s.order[place] = s.order[place - 1];
      }
      s.order[place] = row;
    }
  }
}

/// Rows whose columns all exceed this share of them are independent in any order.
constexpr double kInAnyOrder = 1e-4;

bool run_together(Sweep& s, int end) {
  start_leading(s, end);
  const int count = s.num_taking_part;
  if (count > s.columns) return false;
  order_by_end(s, end);
  s.turned_end = count;
  double square = 0.0;  // of the next row
  int width = 0;
  for (int i = 0; i < count; ++i) {
    const int row = s.order[i];
    const double scale = s.scale[row];
    s.reach[i] = s.list[row];
    if (padded(s.reach[i]) > width) {
      width = padded(s.reach[i]);
      square = square_from(s.rows + (long)row * s.stride, i, width);
    }
    if (!(square > kInAnyOrder * kInAnyOrder * scale * scale)) return false;
    if (square < s.smallest_pivot * s.smallest_pivot * scale * scale) {
      s.smallest_pivot = __builtin_sqrt(square) / scale;
    }
    square = eliminate(s, i, square, true, width);
    double* reflector = s.reflectors + (long)i * s.stride;
    for (int k = width; k < s.stride; k += kPack) at(reflector + k) = Pack{};
    s.residual[row] = -s.upper[row];
  }
  substitute(s, 0, count, 0);
  lower_rank_tolerance(s);
  return true;
}

void fix(Sweep& s, int begin, int end) {
  (void)factorize_level(s, begin, end);
  lower_rank_tolerance(s);
}

void run(Sweep& s, int first, int end, LevelTimer* timer) {
  for (int k = first; k < end; ++k) {
    s.first_column[k] = s.fixed;
    turn_next_levels(s, k, end);
    run_level(s, k);
    if (timer != nullptr) timer->take(k);
  }
  s.first_column[end] = s.fixed;
}

void factorize_last(Sweep& s) {
  const int level = s.solved_last;
  if (level < 0) return;
  for (int j = s.first_column[level]; j < s.columns; ++j) s.q[j] = 0.0;
  s.fixed = s.first_column[level];
  s.needs_pivots = true;
  run_level(s, level);
  s.needs_pivots = false;
  s.solved_last = -1;
}

/// Lᵀ force = −gradient by back substitution over the columns [last, first).
static void balance_gradient(Sweep& s, int first, int last) {
  for (int j = first - 1; j >= last; --j) {
    const int row = s.pivot[j];
    if (row < 0) continue;  // no row resists along this column
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
