#pragma once

#include <vector>

namespace surefoot::solver {

class LevelTimer;

/// Numbers of one sweep of the lexicographic solver over all levels, as plain arrays for the
/// kernels of any instruction set; `SweepMemory` owns them.
///
/// The rows of all levels form one sequence; level k has the rows [level_begin[k],
/// level_begin[k + 1]). Active rows are equalities: those of the hierarchy and inequalities held at
/// a bound. A sweep solves the levels one after the other,
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
  signed char* side = nullptr;  ///< by row: −1 at lower, +1 at upper, 2 equality, 0 inactive

  // x = basis · (y, 1), where y are the swept columns.
  int columns = 0;               ///< size of y
  int stride = 0;                ///< between rows below
  double* basis = nullptr;       ///< unknowns × (columns + 1)
  double* base = nullptr;        ///< row → a · basis, for projected rows
  double* base_value = nullptr;  ///< row → its value at y = 0
  [[nodiscard]] bool is_identity() const { return columns == unknowns; }  ///< the basis

  // The factorization.
  int num_taking_part = 0;
  int* order = nullptr;         ///< active rows; in a level, the used ones come first
  int* order_begin = nullptr;   ///< by level
  int* list = nullptr;          ///< scratch list of rows
  int* first_column = nullptr;  ///< by level: columns fixed by the levels before
  int fixed = 0;                ///< number of fixed columns
  int solved_last = -1;       ///< level whose columns have no rows, see `factorize_last`; −1: none
  bool needs_pivots = false;  ///< forbids such a level
  int first_reflection = 0;   ///< columns fixed before the factorization
  int turned_end = 0;         ///< rows of `order` before it are turned by all reflections so far
  int* reach = nullptr;       ///< column → end of its reflector's non-zero part, in x
  double* rows = nullptr;     ///< row → a · basis · Q
  double* reflectors = nullptr;  ///< column → v of I − β v vᵀ
  double* beta = nullptr;
  int* pivot = nullptr;             ///< column → the row that uses it; −1: fixed without a row
  double* inverse_pivot = nullptr;  ///< column → 1 / L
  double* q = nullptr;
  double* residual = nullptr;  ///< row → a x − bound, for active rows
  double* force = nullptr;     ///< row → multiplier for the level last balanced
  double* gradient = nullptr;  ///< columns

  // Rank policy, see RankTolerance.
  double solve_tolerance = 0.0, keep_tolerance = 0.0, smallest_pivot = 1.0;
  double unused_pivot = 1.0;  ///< the smallest of the pivots too weak to use

  // Results.
  double* y = nullptr;
  double* x = nullptr;
  double* value = nullptr;             ///< row → a x
  double* square_violation = nullptr;  ///< by row
  signed char* state = nullptr;        ///< row → RowState

  // The descent's tableau: the rows [first_row, end_row) turned by the columns fixed so far.
  int first_row = 0, end_row = 0;
  int row_stride = 0;
  double* tableau = nullptr;      ///< column after column, each `row_stride` long
  double* motion = nullptr;       ///< row → its change along a direction
  double* limit_lower = nullptr;  ///< row → limit of a step; −∞: none
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
  /// scale[i] ← ‖aᵢ‖; NaN or ∞ if an element is.
  void (*measure)(Sweep&);
  /// side ← 2 for equalities, 0 if the bound does not exist. False for invalid bounds or rows.
  bool (*read_sides)(Sweep&);
  /// Is an inactive row from `first` on beyond a bound by more than `rounding` ‖a‖?
  bool (*has_violated)(const Sweep&, int first, double rounding);
  /// state, square_violation ← of all rows; those within `tolerance` ‖a‖ of a bound are at it.
  void (*judge_rows)(Sweep&, double tolerance);
  /// Starts a factorization of the rows whose side isn't 0, in the levels [first, end).
  void (*start)(Sweep&, int first, int end);
  /// The same with all rows of the levels [0, end), in the space of x.
  void (*start_leading)(Sweep&, int end);
  /// Sweeps over the levels [0, end) at once, in the space of x, short rows first. False unless all
  /// of their rows are clearly independent, so that their order has no effect.
  bool (*run_together)(Sweep&, int end);
  /// Sweeps over these levels. Each is a lap of the timer, which may be null.
  void (*run)(Sweep&, int first, int end, LevelTimer* timer);
  /// Gives columns to the rows [begin, end) of the order, ignoring their bounds.
  void (*fix)(Sweep&, int begin, int end);
  /// tableau ← base, for the rows [first_row, end_row).
  void (*fill_tableau)(Sweep&);
  /// tableau ← tableau (I − β v vᵀ); v begins at column `first`.
  void (*turn)(Sweep&, const double* v, double beta, int first);
  /// The same for a rotation of the columns `first` and `first` + 1.
  void (*rotate)(Sweep&, int first, double cosine, double sine);
  /// Starts a factorization of the rows listed in `order`, from column `first` of the tableau on.
  void (*gather)(Sweep&, int first);
  /// motion ← tableau · q from column `first` on; 0 if it is at most `rounding` ‖a‖. Is any other
  /// at most `doubtful` ‖a‖?
  bool (*move)(Sweep&, int first, double rounding, double doubtful);
  /// Longest step along the motion within the limits of the rows before `end` (later ones in its
  /// pack have none), and the row that ends it; −1: none.
  double (*longest_step)(Sweep&, int end, int& row);
  /// base_value ← base_value + length · motion.
  void (*advance)(Sweep&, double length);
  /// basis ← Q of the columns that are still free, plus the fixed columns' offset; 0 columns fixed.
  void (*reduce)(Sweep&);
  /// base[row] ← a · basis, for these rows.
  void (*project)(Sweep&, const int* rows, int count);
  /// y ← Q q, with the reflections from column `first` on.
  void (*turn_back)(Sweep&, int first);
  /// x ← basis · (y, 1).
  void (*recover)(Sweep&);
  /// value[i] ← aᵢ x for rows [first, end).
  void (*evaluate)(Sweep&, int first, int end);
  /// Solves a last level again that was solved as a whole, so that its rows have columns and can
  /// balance a gradient; y stays.
  void (*factorize_last)(Sweep&);
  /// Multipliers of earlier rows that balance a level's gradient, down to this column.
  void (*balance)(Sweep&, int level, int last_column);
  /// The same for the gradient q of ½ ‖x‖².
  void (*balance_norm)(Sweep&, int last_column);
};

/// Upper bound of the additions and multiplications of a triangle with so many rows, with its least
/// squares.
constexpr double factorization_flops(int rows, int columns) {
  return 4.0 * rows * columns * (rows < columns ? rows : columns);
}

/// The kernels for the fastest instruction set of this processor.
[[nodiscard]] const SweepKernels& fastest_kernels();

/// The kernels of all instruction sets of this processor, the fastest last.
[[nodiscard]] std::vector<const SweepKernels*> all_kernels();

}  // namespace surefoot::solver
