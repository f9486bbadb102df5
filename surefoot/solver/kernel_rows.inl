// Judges rows one by one; a pack holds several rows.

using Sides = signed char __attribute__((vector_size(kPack), aligned(1), may_alias));

SUREFOOT_INLINE Bits sides_at(const signed char* p) {
  return __builtin_convertvector(*reinterpret_cast<const Sides*>(p), Bits);
}
SUREFOOT_INLINE void write_sides(signed char* p, Bits sides) {
  *reinterpret_cast<Sides*>(p) = __builtin_convertvector(sides, Sides);
}

/// All ones for existing rows, from `row` on.
SUREFOOT_INLINE Bits are_rows(int row, int end) { return (Bits)(kPlaces < (long long)(end - row)); }

SUREFOOT_INLINE bool any(Bits bits) {
  long long all = 0;
#pragma GCC unroll 8
  for (int i = 0; i < kPack; ++i) all |= bits[i];
  return all != 0;
}

bool read_sides(Sweep& s) {
  const Pack infinity = Pack{} + __builtin_inf(), largest = Pack{} + tolerance::kLargest;
  Bits wrong = Bits{};
  for (int i = 0; i < s.num_rows; i += kPack) {
    const Pack given_lower = at(s.lower + i), given_upper = at(s.upper + i);
    const Pack given_scale = at(s.scale + i);
    // Comparing NaN for equality is quiet; ordering raises a floating-point exception.
    const Bits is_number = (Bits)(given_lower == given_lower) & (Bits)(given_upper == given_upper) &
                           (Bits)(given_scale == given_scale);
    const Pack lower = is_number ? given_lower : Pack{};
    const Pack upper = is_number ? given_upper : Pack{};
    const Pack scale = is_number ? given_scale : Pack{};
    const Bits is_lower = (Bits)(lower >= -largest) | (Bits)(lower == -infinity);
    const Bits is_upper = (Bits)(upper <= largest) | (Bits)(upper == infinity);
    const Bits is_sound = is_number & is_lower & is_upper & (Bits)(lower <= upper) &
                          (Bits)(lower <= largest) & (Bits)(upper >= -largest) &
                          (Bits)(scale <= largest);
    wrong |= ~is_sound & are_rows(i, s.num_rows);
    const Bits guess = sides_at(s.side + i);
    const Bits below = (Bits)(guess < 0);
    const Bits has_bound =
        (below & (Bits)(lower > -infinity)) | (~below & (Bits)(upper < infinity));
    const Bits is_equality = (Bits)(lower == upper);
    const Bits kept = guess & has_bound & (Bits)(guess != 2);
    write_sides(s.side + i, (is_equality & 2) | (~is_equality & kept));
  }
  return !any(wrong);
}

/// Loads a pack with zeros for missing rows, where an earlier solve may have left NaN or infinity.
SUREFOOT_INLINE Pack of_rows(const double* p, Bits rows) { return rows ? at(p) : Pack{}; }

bool has_violated(const Sweep& s, int first, double rounding) {
  Bits found = Bits{};
  for (int i = first / kPack * kPack; i < s.num_rows; i += kPack) {
    const Bits rows = are_rows(i, s.num_rows);
    const Pack value = of_rows(s.value + i, rows);
    const Pack above = value - of_rows(s.upper + i, rows);
    const Pack below = of_rows(s.lower + i, rows) - value;
    const Pack limit = rounding * of_rows(s.scale + i, rows);
    const Bits is_beyond = (Bits)(above > limit) | (Bits)(below > limit);
    found |= is_beyond & (Bits)(sides_at(s.side + i) == 0) & rows;
  }
  return any(found);
}

/// The larger one; NaN from infinite bounds counts as no violation.
SUREFOOT_INLINE Pack larger_of(Pack a, Pack b) { return a > b ? a : b; }

void judge_rows(Sweep& s, double tolerance) {
  for (int i = 0; i < s.num_rows; i += kPack) {
    const Bits rows = are_rows(i, s.num_rows);
    const Pack value = of_rows(s.value + i, rows);
    const Pack lower = of_rows(s.lower + i, rows), upper = of_rows(s.upper + i, rows);
    const Pack above = value - upper, below = lower - value;
    const Pack violation = larger_of(larger_of(Pack{}, below), above);
    at(s.square_violation + i) = violation * violation;
    const Pack limit = tolerance * of_rows(s.scale + i, rows);
    const Bits is_equality = (Bits)(lower == upper);
    const Bits touches_upper = (Bits)(above >= -limit), touches_lower = (Bits)(below >= -limit);
    const Bits at_upper = (Bits{} + 1) | ((Bits)(above > limit) & 2);
    const Bits at_lower = -((Bits{} + 1) | ((Bits)(below > limit) & 2));
    const Bits touching = (touches_upper & at_upper) | (~touches_upper & touches_lower & at_lower);
    write_sides(s.state + i, (is_equality & 2) | (~is_equality & touching));
  }
}
