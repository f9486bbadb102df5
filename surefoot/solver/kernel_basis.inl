// Conversions between the spaces of x and y: x = basis · (y, 1).

/// Element i: a[i] · b, for padded vectors.
SUREFOOT_INLINE Pack products(const double* const* a, const double* b, int size) {
  Pack total[kPack] = {};
  for (int j = 0; j < size; j += kPack) {
    const Pack other = at(b + j);
#pragma GCC unroll 8
    for (int i = 0; i < kPack; ++i) total[i] += at(a[i] + j) * other;
  }
  return sums(total);
}

void measure(Sweep& s) {
  for (int i = 0; i < s.num_rows; ++i) s.scale[i] = loose_dot(s.a[i], s.a[i], s.unknowns);
  for (double* scale = s.scale; scale < s.scale + s.num_rows; scale += kPack) {
    for (int k = 0; k < kPack; ++k) scale[k] = __builtin_sqrt(scale[k]);  // at once
  }
}

void evaluate(Sweep& s, int first, int end) {
  for (int i = first; i < end; ++i) s.value[i] = loose_dot(s.a[i], s.x, s.unknowns);
}

/// One reflection of N packs of the basis.
template <int N>
SUREFOOT_INLINE void reflect_basis(const Sweep& s, double* basis, int stride, int j) {
  const double* v = s.reflectors + (long)j * s.stride;
  const int end = s.reach[j];
  Pack along[N] = {};
  for (int i = j; i < end; ++i) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) along[k] += v[i] * at(basis + (long)i * stride + k * kPack);
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) along[k] *= s.beta[j];
  for (int i = j; i < end; ++i) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) at(basis + (long)i * stride + k * kPack) -= v[i] * along[k];
  }
}

/// The reflection j and then the one before it, in one pass over the basis:
///
///     H₋ H = I − v₋ β₋ (v₋ᵀ − (v₋ᵀ v) β vᵀ) − v β vᵀ
template <int N>
SUREFOOT_INLINE void reflect_basis_twice(const Sweep& s, double* basis, int stride, int j) {
  const double* v = s.reflectors + (long)j * s.stride;
  const double* u = v - s.stride;
  const int end = s.reach[j], skip = j / kPack * kPack;  // v is zero before j, and u at its end
  const double cross = dot(u + skip, v + skip, padded(end) - skip);
  double* top = basis + (long)(j - 1) * stride;
  Pack along_v[N] = {}, along_u[N];
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) along_u[k] = u[j - 1] * at(top + k * kPack);
  const double* row = top + stride;
  for (int i = j; i < end; ++i, row += stride) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      const Pack here = at(row + k * kPack);
      along_v[k] += v[i] * here;
      along_u[k] += u[i] * here;
    }
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    along_v[k] *= s.beta[j];
    along_u[k] = (along_u[k] - cross * along_v[k]) * s.beta[j - 1];
    at(top + k * kPack) -= u[j - 1] * along_u[k];
  }
  double* to = top + stride;
  for (int i = j; i < end; ++i, to += stride) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      at(to + k * kPack) -= v[i] * along_v[k] + u[i] * along_u[k];
    }
  }
}

template <int N>
static void reflect_basis_back(const Sweep& s, double* basis, int stride) {
  for (int j = s.fixed - 1; j >= 0; --j) {
    if (s.beta[j] == 0.0) continue;
    if (j > 0 && s.beta[j - 1] != 0.0) {
      reflect_basis_twice<N>(s, basis, stride, j--);
    } else {
      reflect_basis<N>(s, basis, stride, j);
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
  int j = 0;  // a few packs of all rows fit in the cache
  for (; j + 4 * kPack <= stride; j += 4 * kPack) reflect_basis_back<4>(s, s.basis + j, stride);
  for (; j + 2 * kPack <= stride; j += 2 * kPack) reflect_basis_back<2>(s, s.basis + j, stride);
  if (j < stride) reflect_basis_back<1>(s, s.basis + j, stride);
  s.columns = columns;
  s.stride = stride;
  s.fixed = 0;
}

/// Rows that are projected together.
constexpr int kTogether = 4;

/// to[r] ← Σ a[r][i] basis(i, :) over [first, end), for rows of N packs from `from` on.
template <int N>
SUREFOOT_INLINE void combine(const Sweep& s, const double* const* a, int first, int end, int from,
                             double* const* to) {
  Pack total[kTogether][N] = {};
  const double* row = s.basis + (long)first * s.stride + from;
  for (int i = first; i < end; ++i, row += s.stride) {
#pragma GCC unroll 4
    for (int r = 0; r < kTogether; ++r) {
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) total[r][k] += a[r][i] * at(row + k * kPack);
    }
  }
#pragma GCC unroll 4
  for (int r = 0; r < kTogether; ++r) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) at(to[r] + from + k * kPack) = total[r][k];
  }
}

static void project_together(Sweep& s, const int* rows) {
  const double* a[kTogether];
  double* to[kTogether];
  for (int r = 0; r < kTogether; ++r) {
    a[r] = s.a[rows[r]];
    to[r] = s.base + (long)rows[r] * s.stride;
  }
  const auto is_zero = [&](int i) {
    return a[0][i] == 0.0 && a[1][i] == 0.0 && a[2][i] == 0.0 && a[3][i] == 0.0;
  };
  int first = 0, end = s.unknowns;
  while (end > 0 && is_zero(end - 1)) --end;
  while (first < end && is_zero(first)) ++first;
  int j = 0;
  for (; j + 2 * kPack <= s.stride; j += 2 * kPack) combine<2>(s, a, first, end, j, to);
  if (j < s.stride) combine<1>(s, a, first, end, j, to);
  for (int r = 0; r < kTogether; ++r) {
    s.base_value[rows[r]] = to[r][s.columns];
  }
  for (int r = 0; r < kTogether; ++r) to[r][s.columns] = 0.0;
}

static void project_identity(Sweep& s, int row) {
  double* to = s.base + (long)row * s.stride;
  s.base_value[row] = 0.0;
  for (int j = 0; j < s.columns; ++j) to[j] = s.a[row][j];
  for (int j = s.columns; j < s.stride; ++j) to[j] = 0.0;
}

void project(Sweep& s, const int* rows, int count) {
  if (s.columns == s.unknowns) {  // the basis is the identity
    for (int i = 0; i < count; ++i) project_identity(s, rows[i]);
    return;
  }
  int i = 0;
  for (; i + kTogether <= count; i += kTogether) project_together(s, rows + i);
  if (i == count) return;
  int rest[kTogether];
  for (int r = 0; r < kTogether; ++r) rest[r] = rows[i + r < count ? i + r : count - 1];
  project_together(s, rest);
}

/// y of N packs stays in registers; two reflections at a time, as in `reflect_basis_twice`.
template <int N>
static void turn_back_packs(Sweep& s, int first) {
  Pack y[N];
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) y[k] = at(s.q + k * kPack);
  for (int j = s.fixed - 1; j >= first; --j) {
    if (s.beta[j] == 0.0) continue;
    const bool is_pair = j > first && s.beta[j - 1] != 0.0;
    const double* v = s.reflectors + (long)j * s.stride;
    const double* u = is_pair ? v - s.stride : v;
    const int begin_v = j / kPack, begin_u = (is_pair ? j - 1 : j) / kPack;  // packs before: unset
    Pack v_y = Pack{}, u_y = Pack{}, u_v = Pack{};
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      if (k < begin_u) continue;
      const Pack there = at(u + k * kPack);
      u_y += there * y[k];
      if (k < begin_v) continue;
      const Pack here = at(v + k * kPack);
      v_y += here * y[k];
      u_v += here * there;
    }
    const Pack along_v = sum(v_y) * s.beta[j];
    const Pack cross = sum(u_v);
    const Pack along_u = is_pair ? (sum(u_y) - cross * along_v) * s.beta[j - 1] : Pack{};
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      if (k < begin_u) continue;
      y[k] -= along_u * at(u + k * kPack);
      if (k >= begin_v) y[k] -= along_v * at(v + k * kPack);
    }
    if (is_pair) --j;
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) at(s.y + k * kPack) = y[k];
}

void turn_back(Sweep& s, int first) {
  switch (s.stride / kPack) {
    case 1:
      return turn_back_packs<1>(s, first);
    case 2:
      return turn_back_packs<2>(s, first);
    case 4:
      return turn_back_packs<4>(s, first);
    default:
      break;
  }
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
  const double* list[kPack];
  for (int i = 0; i < s.unknowns; i += kPack) {
#pragma GCC unroll 8
    for (int k = 0; k < kPack; ++k) {
      list[k] = s.basis + (long)(i + k < s.unknowns ? i + k : s.unknowns - 1) * s.stride;
    }
    at(s.x + i) = products(list, s.y, s.stride);
  }
}
