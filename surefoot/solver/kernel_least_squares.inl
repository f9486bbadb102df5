// Levels with more rows than free columns.

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

/// Least squares with more rows than columns by column reflections. Stable for rows of different
/// scales: takes the longest column and its largest element first (Powell and Reid 1969). Sets q of
/// `columns`.
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
/// longest after projection, for rows whose scales differ by less than kSimilar.
constexpr double kFullRank = 1e-4;
constexpr double kSimilar = 1e3;

/// Solves a last level of equalities with at least as many rows as free columns: takes all columns
/// at once without a factorization from the right, so that no row owns them. False if their rank
/// isn't clear.
static bool solve_last(Sweep& s, int begin, int end) {
  const int free = s.columns - s.fixed;
  const int num_rows = end - begin;
  if (s.needs_pivots || end != s.num_taking_part || free == 0 || num_rows < free) return false;
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
