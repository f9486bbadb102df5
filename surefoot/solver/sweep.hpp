#pragma once

#include <vector>

namespace surefoot {

class LevelTimer;

/// Numbers of one sweep of the lexicographic solver over all levels, as plain arrays that the
/// kernels of any instruction set can work on; `SweepMemory` owns them.
///
/// The rows of all levels stand in one sequence, level k has the rows
/// [level_begin[k], level_begin[k + 1]). Rows that take part are equalities: those of the hierarchy
/// and inequalities held at one of their bounds. A sweep solves the levels one after the other,
///
///     min ‖Aₖ x − bₖ‖² without changing the residuals of the levels before,
///
/// with one orthogonal factorization: reflections Q from the right turn the rows, in this order,
/// into a lower trapezoidal matrix, A Q = [L 0], and q = Qᵀ x follows by substitution. A column of
/// Q that a level has used is fixed for all later levels.
struct Sweep {
  // The hierarchy.
  int unknowns = 0, num_levels = 0, num_rows = 0;
  int* level_begin = nullptr;
  const double** a = nullptr;   ///< row → its `unknowns` coefficients
  double* lower = nullptr;      ///< by row
  double* upper = nullptr;      ///< by row
  double* scale = nullptr;      ///< ‖a‖, by row
  signed char* side = nullptr;  ///< by row: −1 at lower, +1 at upper, 2 equality, 0 no part

  // What is known of x = basis · (y, 1): y are the columns that are swept.
  int columns = 0;               ///< size of y
  int stride = 0;                ///< from row to row in what follows
  double* basis = nullptr;       ///< unknowns × (columns + 1)
  double* base = nullptr;        ///< row → a · basis, of those that have been projected
  double* base_value = nullptr;  ///< row → its value at y = 0
  [[nodiscard]] bool is_identity() const { return columns == unknowns; }  ///< the basis

  // The factorization.
  int num_taking_part = 0;
  int* order = nullptr;          ///< rows that take part; in a level, the used ones come first
  int* order_begin = nullptr;    ///< by level
  int* list = nullptr;           ///< of rows, for whoever needs one
  int* first_column = nullptr;   ///< by level: columns that the levels before have fixed
  int fixed = 0;                 ///< columns that are fixed
  int solved_last = -1;          ///< level whose columns no row has, see `factorize_last`; −1: none
  bool needs_pivots = false;     ///< so there must be none
  int first_reflection = 0;      ///< columns that were fixed when the factorization began
  int turned_end = 0;            ///< rows of `order` before it are turned by all reflections so far
  int* reach = nullptr;          ///< column → its reflector is zero from there on, in x
  double* rows = nullptr;        ///< row → a · basis · Q
  double* reflectors = nullptr;  ///< column → v of I − β v vᵀ
  double* beta = nullptr;
  int* pivot = nullptr;             ///< column → the row that uses it; −1: fixed where it is
  double* inverse_pivot = nullptr;  ///< column → 1 / L
  double* q = nullptr;
  double* residual = nullptr;  ///< row → a x − bound, of rows that take part
  double* force = nullptr;     ///< row → multiplier of the level asked for last
  double* gradient = nullptr;  ///< columns

  // Rank policy, see RankTolerance.
  double solve_tolerance = 0.0, keep_tolerance = 0.0, smallest_pivot = 1.0;
  double unused_pivot = 1.0;  ///< the smallest of those that were too weak to be used

  // Results.
  double* y = nullptr;
  double* x = nullptr;
  double* value = nullptr;             ///< row → a x
  double* square_violation = nullptr;  ///< by row
  signed char* state = nullptr;        ///< row → RowState

  // The tableau of a search: the rows [first_row, end_row) turned by the columns fixed so far.
  int first_row = 0, end_row = 0;
  int row_stride = 0;
  double* tableau = nullptr;      ///< column after column, each `row_stride` long
  double* motion = nullptr;       ///< row → its change along a direction
  double* limit_lower = nullptr;  ///< row → bound that a step must respect; −∞ where none is
  double* limit_upper = nullptr;

  // Least squares of a level with more rows than columns.
  int tall_stride = 0;
  double* tall = nullptr;  ///< column after column, each `tall_stride` long
  int* tall_order = nullptr;
};

/// The kernels, compiled for one instruction set. None allocates.
struct SweepKernels {
  const char* name;
  int pack;  ///< strides are multiples of it
  /// scale[i] ← ‖aᵢ‖; NaN or ∞ where an element is.
  void (*measure)(Sweep&);
  /// side ← 2 for equalities, 0 where there is no such bound. False if bounds or rows make no
  /// sense.
  bool (*read_sides)(Sweep&);
  /// Whether a row from `first` on that takes no part is beyond a bound by more than `rounding`
  /// ‖a‖.
  bool (*has_violated)(const Sweep&, int first, double rounding);
  /// state, square_violation ← of all rows; those within `tolerance` ‖a‖ of a bound are at it.
  void (*judge_rows)(Sweep&, double tolerance);
  /// Starts a factorization of the rows whose side isn't 0, in the levels [first, end).
  void (*start)(Sweep&, int first, int end);
  /// The same with all rows of the levels [0, end), in the space of x.
  void (*start_leading)(Sweep&, int end);
  /// Sweeps over the levels [0, end), in the space of x, without order: where all of their rows
  /// are clearly independent it says nothing, and short rows come first. False where they aren't.
  bool (*run_together)(Sweep&, int end);
  /// Sweeps over these levels. Each is a lap of the timer, which may be null.
  void (*run)(Sweep&, int first, int end, LevelTimer* timer);
  /// Gives columns to the rows [begin, end) of the order, without looking at their bounds.
  void (*fix)(Sweep&, int begin, int end);
  /// tableau ← base, for the rows [first_row, end_row).
  void (*fill_tableau)(Sweep&);
  /// tableau ← tableau (I − β v vᵀ); v begins at column `first`.
  void (*turn)(Sweep&, const double* v, double beta, int first);
  /// The same for a rotation of the columns `first` and `first` + 1.
  void (*rotate)(Sweep&, int first, double cosine, double sine);
  /// Starts a factorization of the rows listed in `order`, from column `first` of the tableau on.
  void (*gather)(Sweep&, int first);
  /// motion ← tableau · q from column `first` on; 0 where it is at most `rounding` ‖a‖. Whether
  /// any other is at most `doubtful` ‖a‖.
  bool (*move)(Sweep&, int first, double rounding, double doubtful);
  /// Longest step along the motion within the limits of the rows before `end`, those after it in a
  /// pack have none, and the row that ends it, −1 for none.
  double (*longest_step)(Sweep&, int end, int& row);
  /// base_value ← base_value + length · motion.
  void (*advance)(Sweep&, double length);
  /// basis ← Q of the columns that are still free, and what the fixed ones say; 0 columns fixed.
  void (*reduce)(Sweep&);
  /// base[row] ← a · basis, for these rows.
  void (*project)(Sweep&, const int* rows, int count);
  /// y ← Q q, with the reflections from column `first` on.
  void (*turn_back)(Sweep&, int first);
  /// x ← basis · (y, 1).
  void (*recover)(Sweep&);
  /// value[i] ← aᵢ x for rows [first, end).
  void (*evaluate)(Sweep&, int first, int end);
  /// A last level that was solved as a whole is solved again, so that its rows have columns and
  /// can hold x against a gradient; y as it was found stays.
  void (*factorize_last)(Sweep&);
  /// Multipliers with which earlier rows balance the gradient of a level, down to this column.
  void (*balance)(Sweep&, int level, int last_column);
  /// The same for the gradient q of ½ ‖x‖².
  void (*balance_norm)(Sweep&, int last_column);
};

/// Additions and multiplications that make a triangle of so many rows, at most, with its least
/// squares.
constexpr double factorization_flops(int rows, int columns) {
  return 4.0 * rows * columns * (rows < columns ? rows : columns);
}

/// The kernels for the fastest instruction set of this processor.
[[nodiscard]] const SweepKernels& fastest_kernels();

/// The kernels of every instruction set that this processor has, the fastest last.
[[nodiscard]] std::vector<const SweepKernels*> all_kernels();

}  // namespace surefoot
