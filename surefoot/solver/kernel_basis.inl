// Between the space of x and that of y: x = basis · (y, 1).

void measure(Sweep& s) {
  for (int i = 0; i < s.num_rows; ++i) {
    s.scale[i] = __builtin_sqrt(loose_dot(s.a[i], s.a[i], s.unknowns));
  }
}

void evaluate(Sweep& s, int first, int end) {
  for (int i = first; i < end; ++i) s.value[i] = loose_dot(s.a[i], s.x, s.unknowns);
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
