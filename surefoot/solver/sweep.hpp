#pragma once

#include <vector>

namespace surefoot {

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
  int stride = 0;                ///< from row to row in all matrices but `reflectors_T`
  double* basis = nullptr;       ///< unknowns × (columns + 1)
  double* base = nullptr;        ///< row → a · basis
  double* base_value = nullptr;  ///< row → its value at y = 0

  // The factorization.
  int num_taking_part = 0;
  int* order = nullptr;          ///< rows that take part; in a level, the used ones come first
  int* order_begin = nullptr;    ///< by level
  int* first_column = nullptr;   ///< by level: columns that the levels before have fixed
  int fixed = 0;                 ///< columns that are fixed
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

  // Results.
  double* y = nullptr;
  double* x = nullptr;
  double* value = nullptr;  ///< row → a x

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
  /// Starts a factorization of the rows whose side isn't 0, in the levels [first, end).
  void (*start)(Sweep&, int first, int end);
  /// The same for the rows that are listed in `order` and `order_begin` already.
  void (*restart)(Sweep&);
  /// Sweeps over these levels.
  void (*run)(Sweep&, int first, int end);
  /// Gives columns to the rows [begin, end) of the order, without looking at their bounds.
  void (*fix)(Sweep&, int begin, int end);
  /// base ← base · Q without the columns that are fixed, for the rows listed; 0 columns fixed.
  void (*turn)(Sweep&, const int* list, int count);
  /// value[i] ← base · y of the rows listed.
  void (*multiply)(Sweep&, const int* list, int count);
  /// basis ← Q of the columns that are still free, and what the fixed ones say; 0 columns fixed.
  void (*reduce)(Sweep&);
  /// base[row] ← a · basis.
  void (*project)(Sweep&, int row);
  /// y ← Q q and x ← basis · (y, 1).
  void (*recover)(Sweep&);
  /// value[i] ← aᵢ x for rows [first, end).
  void (*evaluate)(Sweep&, int first, int end);
  /// Multipliers with which earlier rows balance the gradient of a level, down to this column.
  void (*balance)(Sweep&, int level, int last_column);
  /// The same for the gradient q of ½ ‖x‖².
  void (*balance_norm)(Sweep&, int last_column);
};

/// The kernels for the fastest instruction set of this processor.
[[nodiscard]] const SweepKernels& fastest_kernels();

/// The kernels of every instruction set that this processor has, the fastest last.
[[nodiscard]] std::vector<const SweepKernels*> all_kernels();

}  // namespace surefoot
