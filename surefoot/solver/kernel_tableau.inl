// The descent's tableau: columns of many rows, where a pack holds several rows.

/// First row of the pack that holds the tableau's first row.
SUREFOOT_INLINE int first_pack(const Sweep& s) { return s.first_row / kPack * kPack; }

void fill_tableau(Sweep& s) {
  for (int row = s.first_row; row < s.end_row; ++row) {
    const double* from_row = s.base + (long)row * s.stride;
    double* to = s.tableau + row;
    for (int j = 0; j < s.columns; ++j) to[(long)j * s.row_stride] = from_row[j];
  }
}

/// Turns the rows of `N` packs from `row` on.
template <int N>
static void turn_rows(Sweep& s, int row, const double* v, double beta, int first) {
  double* columns = s.tableau + row;
  Pack along[N] = {};
  const double* column = columns + (long)first * s.row_stride;
  for (int j = first; j < s.columns; ++j, column += s.row_stride) {
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) along[k] += v[j] * at(column + k * kPack);
  }
#pragma GCC unroll 8
  for (int k = 0; k < N; ++k) along[k] *= beta;
  double* to = columns + (long)first * s.row_stride;
  for (int j = first; j < s.columns; ++j, to += s.row_stride) {
#pragma GCC unroll 8
    for (int k = 0; k < N; ++k) at(to + k * kPack) -= v[j] * along[k];
  }
}

void turn(Sweep& s, const double* v, double beta, int first) {
  int row = first_pack(s);
  for (; row + 4 * kPack <= s.end_row; row += 4 * kPack) turn_rows<4>(s, row, v, beta, first);
  for (; row < s.end_row; row += kPack) turn_rows<1>(s, row, v, beta, first);
}

void rotate(Sweep& s, int first, double cosine, double sine) {
  double* left = s.tableau + (long)first * s.row_stride;
  double* right = left + s.row_stride;
  for (int i = first_pack(s); i < s.end_row; i += kPack) {
    const Pack a = at(left + i), b = at(right + i);
    at(left + i) = cosine * a + sine * b;
    at(right + i) = cosine * b - sine * a;
  }
}

void gather(Sweep& s, int first) {
  s.fixed = s.first_reflection = first;
  s.turned_end = s.num_taking_part;
  for (int j = 0; j < s.stride; j += kPack) at(s.q + j) = Pack{};
  for (int i = 0; i < s.num_taking_part; ++i) {
    const int row = s.order[i];
    double* to = s.rows + (long)row * s.stride;
    for (int j = 0; j < s.stride; j += kPack) at(to + j) = Pack{};
    const double* from_row = s.tableau + row;
    for (int j = first; j < s.columns; ++j) to[j] = from_row[(long)j * s.row_stride];
  }
}

SUREFOOT_INLINE Pack absolute(Pack p) { return (Pack)((Bits)p & (Bits{} + 0x7fffffffffffffff)); }

bool move(Sweep& s, int first, double rounding, double doubtful) {
  Bits doubts = Bits{};
  for (int i = first_pack(s); i < s.end_row; i += kPack) {
    Pack even = Pack{}, odd = Pack{};
    const double* column = s.tableau + i + (long)first * s.row_stride;
    int j = first;
    for (; j + 1 < s.columns; j += 2, column += 2 * (long)s.row_stride) {
      even += s.y[j] * at(column);
      odd += s.y[j + 1] * at(column + s.row_stride);
    }
    if (j < s.columns) even += s.y[j] * at(column);
    const Pack motion = even + odd, size = absolute(motion);
    const Pack scale = at(s.scale + i);  // 0 if its square overflowed
    const Bits is_moving = (Bits)(size > rounding * scale) & (Bits)(scale > Pack{});
    at(s.motion + i) = is_moving ? motion : Pack{};
    doubts |= is_moving & (Bits)(size <= doubtful * scale);
  }
  return any(doubts);
}

double longest_step(Sweep& s, int end, int& row) {
  const Pack infinity = Pack{} + __builtin_inf();
  Pack least = infinity;
  for (int i = first_pack(s); i < end; i += kPack) {
    const Pack rate = at(s.motion + i);
    const Pack limit = rate > Pack{} ? at(s.limit_upper + i) : at(s.limit_lower + i);
    const Pack way = limit - at(s.base_value + i);
    const Pack length = rate != Pack{} ? way / (rate != Pack{} ? rate : Pack{} + 1.0) : infinity;
    at(s.value + i) = length;
    least = length < least ? length : least;
  }
  double length = least[0];
  for (int k = 1; k < kPack; ++k) length = smaller(length, least[k]);
  length = larger(length, 0.0);
  row = -1;
  if (length == __builtin_inf()) return length;
  double best_rate = 0.0;
  for (int pack = first_pack(s); pack < end; pack += kPack) {
    if (!any((Bits)(at(s.value + pack) <= length))) continue;
    for (int i = pack; i < pack + kPack; ++i) {  // among equal steps the fastest row's
      if (s.value[i] > length) continue;
      const double relative_rate = absolute(s.motion[i]) / s.scale[i];
      if (relative_rate > best_rate) {
        best_rate = relative_rate;
        row = i;
      }
    }
  }
  return length;
}

void advance(Sweep& s, double length) {
  for (int i = first_pack(s); i < s.end_row; i += kPack) {
    at(s.base_value + i) += length * at(s.motion + i);
  }
}
