// Null space of the leading equalities, x = basis · (y, 1), and the rows in terms of y.
#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/quiet_overflow.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

/// Squared column lengths that are safe to divide by.
constexpr double kMinSquare = 1e-280;
constexpr double kMaxSquare = 1e280;

}  // namespace

// Levels of equalities before the first inequality leave no choice: they are swept once, and their
// null space has the unknowns of all that follows.
void LexicographicSolver::sweep_leading_equalities() {
  Sweep& s = memory_.sweep;
  const int pack = kernels_.pack;
  s.columns = s.unknowns;
  s.stride = (s.unknowns + pack - 1) / pack * pack;
  s.fixed = 0;
  s.solve_tolerance = options_.rank.solve;
  s.keep_tolerance = options_.rank.keep;
  s.smallest_pivot = s.unused_pivot = 1.0;
  if (first_level_ > 0) {
    timer_.start();
    const bool are_independent = kernels_.run_together(s, first_level_);
    if (first_level_ == 1) timer_.lap(0);
    if (!are_independent) {
      s.smallest_pivot = 1.0;
      kernels_.start_leading(s, first_level_);
      timer_.start();
      kernels_.run(s, 0, first_level_, timer());
    }
    for (int k = 0; k < first_level_; ++k) {
      const int used = are_independent ? s.level_begin[k + 1] : s.first_column[k + 1];
      solution_.levels[at(k)].degrees_of_freedom_left = s.unknowns - used;
    }
    const double flops = factorization_flops(s.num_taking_part, s.unknowns);
    budget_.spend(are_independent ? flops : 2.0 * flops);
  }
  if (s.fixed > 0) {
    budget_.spend(4.0 * s.unknowns * s.fixed * (s.unknowns - s.fixed + 1));
    kernels_.reduce(s);
  }
  keep_tolerance_ = s.keep_tolerance;
  smallest_pivot_ = s.smallest_pivot;
  unused_pivot_ = s.unused_pivot;
  is_orthonormal_ = true;
  forget_projections();
}

bool LexicographicSolver::can_use(const Substitution& substitution) const {
  const Sweep& s = memory_.sweep;
  return substitution.basis.rows() == s.unknowns && substitution.basis.cols() < s.unknowns &&
         substitution.offset.size() == s.unknowns &&
         substitution.num_levels <= static_cast<std::size_t>(first_level_) &&
         std::isfinite(substitution.offset.squaredNorm());
}

// inverse_pivot ← 1 / length of each column; false for a degenerate column.
bool LexicographicSolver::measure_columns(const Substitution& substitution) {
  Sweep& s = memory_.sweep;
  const Index columns = substitution.basis.cols();
  double* square = s.inverse_pivot;
  std::fill_n(square, columns, 0.0);
  for (Index i = 0; i < s.unknowns; ++i) {
    const double* row = substitution.basis.data() + i * columns;
    for (Index j = 0; j < columns; ++j) square[j] += row[j] * row[j];
  }
  bool are_directions = true;
  for (Index j = 0; j < columns; ++j) {
    are_directions = are_directions && square[j] >= kMinSquare && square[j] <= kMaxSquare;
    square[j] = are_directions ? 1.0 / std::sqrt(square[j]) : 0.0;
  }
  return are_directions;
}

bool LexicographicSolver::is_usable(const Substitution& substitution) {
  const QuietOverflow quiet;
  return can_use(substitution) && measure_columns(substitution);
}

// Uses a given basis. Its columns are scaled to length 1, because the rest of a row is compared
// with its length in the space of x.
void LexicographicSolver::substitute(const Substitution& substitution) {
  Sweep& s = memory_.sweep;
  const auto pack = static_cast<Index>(kernels_.pack);
  const Index columns = substitution.basis.cols();
  const Index stride = (columns + pack) / pack * pack;
  for (Index i = 0; i < s.unknowns; ++i) {
    double* row = s.basis + i * stride;
    for (Index j = 0; j < columns; ++j) row[j] = substitution.basis(i, j) * s.inverse_pivot[j];
    row[columns] = substitution.offset[i];
    std::fill(row + columns + 1, row + stride, 0.0);
  }
  s.columns = static_cast<int>(columns);
  s.stride = static_cast<int>(stride);
  s.fixed = 0;
  s.solve_tolerance = options_.rank.solve;
  keep_tolerance_ = options_.rank.keep;
  smallest_pivot_ = unused_pivot_ = 1.0;
  is_orthonormal_ = false;
  budget_.spend(4.0 * static_cast<double>(s.unknowns * columns));
  first_level_ = static_cast<int>(substitution.num_levels);
  Index left = s.unknowns;
  for (int k = 0; k < first_level_; ++k) {
    left = std::max(columns, left - (s.level_begin[k + 1] - s.level_begin[k]));
    solution_.levels[at(k)].degrees_of_freedom_left = k + 1 == first_level_ ? columns : left;
  }
  forget_projections();
}

// Gram-Schmidt, twice: then the shortest y gives the shortest x.
void LexicographicSolver::make_basis_orthonormal() {
  Sweep& s = memory_.sweep;
  Eigen::Map<Rows::RowMajor, 0, Eigen::OuterStride<>> basis(s.basis, s.unknowns, s.columns + 1,
                                                            Eigen::OuterStride<>(s.stride));
  for (int j = 0; j <= s.columns; ++j) {
    auto column = basis.col(j);
    for (int i = 0; i < 2 * j; ++i) column -= basis.col(i % j).dot(column) * basis.col(i % j);
    if (j < s.columns) column /= column.norm();
  }
  budget_.spend(8.0 * s.unknowns * s.columns * (s.columns + 1));
  is_orthonormal_ = true;
  forget_projections();
}

void LexicographicSolver::forget_projections() {
  Sweep& s = memory_.sweep;
  const double value = s.is_identity() ? 0.0 : kInfinity;
  for (int row = s.level_begin[first_level_]; row < s.num_rows; ++row) s.base_value[row] = value;
}

// Projects the active rows, or all, that aren't projected yet.
void LexicographicSolver::project_rows(bool are_all) {
  Sweep& s = memory_.sweep;
  int count = 0;
  if (s.is_identity() && !are_all) return;  // a sweep reads the rows themselves
  for (int row = s.level_begin[first_level_]; row < s.num_rows; ++row) {
    if (s.is_identity()) {
      s.list[count++] = row;
    } else if ((are_all || s.side[row] != 0) && s.base_value[row] == kInfinity) {
      s.list[count++] = row;
    }
  }
  kernels_.project(s, s.list, count);
  budget_.spend(2.0 * count * s.unknowns * (s.columns + 1));
}

}  // namespace surefoot::solver
