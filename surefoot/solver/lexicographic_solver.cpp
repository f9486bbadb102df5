#include "surefoot/solver/lexicographic_solver.hpp"

#include "surefoot/solver/denormals.hpp"
#include "surefoot/solver/row_states.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot {
namespace {

using Index = Eigen::Index;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Squared lengths of columns that can be divided by.
constexpr double kSmallest = 1e-280;
constexpr double kLargest = 1e280;
/// Times that a guess is improved before the search starts without one.
constexpr int kTries = 2;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Of a triangle from so many rows, at most, with its least squares.
double factorization_flops(int rows, int columns) {
  return 4.0 * rows * columns * std::min(rows, columns);
}

}  // namespace

LexicographicSolver::LexicographicSolver(const Hierarchy& capacity,
                                         const LexicographicOptions& options)
    : options_(options),
      memory_(capacity, at(capacity.unknowns())),
      kernels_(options.kernels != nullptr ? *options.kernels : fastest_kernels()),
      memory_of_rows_(capacity),
      search_(capacity),
      descent_(capacity),
      budget_(options.budget, options.clock),
      cascade_(
          capacity,
          {.rank = options.rank, .max_iterations = options.max_iterations, .clock = options.clock}),
      blockers_(capacity) {
  if (budget_.is_limited() && options_.max_sweeps == 0) {
    options_.max_sweeps = LexicographicOptions{}.max_sweeps;
  }
  kept_.x = Eigen::VectorXd::Zero(capacity.unknowns());
  kept_.freedom_left.assign(capacity.num_levels() + 1, 0);
  solution_.x = Eigen::VectorXd::Zero(capacity.unknowns());
  solution_.levels.resize(capacity.num_levels());
  for (std::size_t k = 0; k < capacity.num_levels(); ++k) {
    solution_.levels[k].rows.assign(at(capacity.level(k).max_rows()), RowState::inactive);
  }
}

const Solution& LexicographicSolver::solve(const Hierarchy& hierarchy) noexcept {
  return solve(hierarchy, nullptr);
}

const Solution& LexicographicSolver::solve(const Hierarchy& hierarchy,
                                           const Substitution& substitution) noexcept {
  return solve(hierarchy, &substitution);
}

const Solution& LexicographicSolver::solve(const Hierarchy& hierarchy,
                                           const Substitution* substitution) noexcept {
  const double start = options_.clock != nullptr ? options_.clock() : 0.0;
  solve_untimed(hierarchy, substitution);
  if (options_.clock != nullptr) solution_.time = options_.clock() - start;
  return solution_;
}

void LexicographicSolver::solve_untimed(const Hierarchy& hierarchy,
                                        const Substitution* substitution) {
  const FlushDenormals flush_denormals;
  const bool is_cold = !options_.warm_start || !has_guess_;
  budget_.start();
  is_swept_ = false;
  if (!fits(hierarchy) || !load(hierarchy)) return reject(hierarchy);
  num_sweeps_ = num_descents_ = 0;
  solution_.status = SolveStatus::optimal;
  solution_.failed_level = -1;
  if (substitution != nullptr && fits(*substitution) && measure_columns(*substitution)) {
    substitute(*substitution);
  } else {
    sweep_leading_equalities();
  }
  Outcome outcome = options_.max_sweeps > 0 ? Outcome::optimal : Outcome::stuck;
  const bool is_far_off =
      is_cold && options_.max_sweeps > 0 && !budget_.is_spent() && begins_far_off();
  if (is_far_off) outcome = descend();
  if (outcome == Outcome::optimal) outcome = find_active_rows(!is_far_off);
  if (outcome == Outcome::optimal) {
    describe(hierarchy);
    count_freedom();
    is_swept_ = true;
  } else if (outcome == Outcome::out_of_budget) {
    take_kept_point();
    describe(hierarchy);
  } else {
    take_from_cascade(hierarchy);
    if (solution_.status == SolveStatus::optimal && options_.max_sweeps > 0 && polish()) {
      describe(hierarchy);
      count_freedom();
      is_swept_ = true;
    }
    num_sweeps_ = options_.max_sweeps + 1;
  }
  if (!is_finite(solution_, hierarchy.num_levels())) return reject(hierarchy);
  clear_levels(solution_, hierarchy.num_levels());
  const Sweep& s = memory_.sweep;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    memory_of_rows_.remember(k, hierarchy.level(k), s.side + s.level_begin[k]);
  }
  memory_of_rows_.forget_from(hierarchy.num_levels());
  has_guess_ = true;
}

const std::vector<LevelBlockers>& LexicographicSolver::blockers() noexcept {
  if (is_swept_) {
    blockers_.find(memory_.sweep, kernels_, first_level_, search_);
  } else {
    blockers_.forget();
  }
  return blockers_.levels();
}

bool LexicographicSolver::fits(const Hierarchy& hierarchy) const {
  if (hierarchy.unknowns() != solution_.x.size()) return false;
  if (hierarchy.num_levels() > solution_.levels.size()) return false;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (at(hierarchy.level(k).num_rows()) > solution_.levels[k].rows.size()) return false;
  }
  return true;
}

bool LexicographicSolver::fits(const Substitution& substitution) const {
  const Sweep& s = memory_.sweep;
  return substitution.basis.rows() == s.unknowns && substitution.basis.cols() < s.unknowns &&
         substitution.offset.size() == s.unknowns &&
         substitution.num_levels <= static_cast<std::size_t>(first_level_) &&
         std::isfinite(substitution.offset.sum());
}

// inverse_pivot ← 1 / length of each column; false if one is no direction.
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
    are_directions = are_directions && square[j] >= kSmallest && square[j] <= kLargest;
    square[j] = are_directions ? 1.0 / std::sqrt(square[j]) : 0.0;
  }
  return are_directions;
}

// Reads all rows; false if a number makes no sense.
bool LexicographicSolver::load(const Hierarchy& hierarchy) {
  Sweep& s = memory_.sweep;
  s.unknowns = static_cast<int>(hierarchy.unknowns());
  s.num_levels = static_cast<int>(hierarchy.num_levels());
  s.num_rows = 0;
  bool has_room = true;
  for (int k = 0; k < s.num_levels; ++k) {
    const Level& level = hierarchy.level(at(k));
    s.level_begin[k] = s.num_rows;
    if (options_.warm_start) {
      memory_of_rows_.recall(at(k), level, s.side + s.num_rows);
    } else {
      std::fill_n(s.side + s.num_rows, level.num_rows(), static_cast<signed char>(0));
    }
    append_level(s, level);
    has_room = has_room && !level.has_overflowed();
  }
  s.level_begin[s.num_levels] = s.num_rows;
  kernels_.measure(s);
  const bool is_sound = kernels_.read_sides(s);
  int row = 0;
  while (row < s.num_rows && s.side[row] == 2) ++row;
  for (first_level_ = 0; first_level_ < s.num_levels; ++first_level_) {
    if (row < s.level_begin[first_level_ + 1]) break;
  }
  return is_sound && has_room;
}

void LexicographicSolver::reject(const Hierarchy& hierarchy) {
  solution_.status = SolveStatus::invalid_input;
  solution_.x.setZero();
  is_swept_ = false;
  num_sweeps_ = 0;
  forget();
  clear_levels(solution_, 0);
  solution_.failed_level = first_unsound_level(hierarchy);
}

// Levels of equalities before the first inequality leave no choice: they are swept once, and what
// they leave free are the unknowns of all that follows.
void LexicographicSolver::sweep_leading_equalities() {
  Sweep& s = memory_.sweep;
  const int pack = kernels_.pack;
  s.columns = s.unknowns;
  s.stride = (s.unknowns + pack - 1) / pack * pack;
  s.fixed = 0;
  s.solve_tolerance = options_.rank.solve;
  s.keep_tolerance = options_.rank.keep;
  s.smallest_pivot = 1.0;
  if (first_level_ > 0) {
    const bool are_independent = kernels_.run_together(s, first_level_);
    if (!are_independent) {
      s.smallest_pivot = 1.0;
      kernels_.start_leading(s, first_level_);
      kernels_.run(s, 0, first_level_);
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
  is_orthonormal_ = true;
  forget_projections();
}

// The same where the basis is given. Its columns get the length 1: what is left of a row is
// compared with its length in the space of x.
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
  smallest_pivot_ = 1.0;
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

void LexicographicSolver::forget_projections() {
  Sweep& s = memory_.sweep;
  const double value = s.is_identity() ? 0.0 : kInfinity;
  for (int row = s.level_begin[first_level_]; row < s.num_rows; ++row) s.base_value[row] = value;
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

void LexicographicSolver::sweep() {
  Sweep& s = memory_.sweep;
  project_rows(false);
  s.keep_tolerance = keep_tolerance_;
  s.smallest_pivot = smallest_pivot_;
  kernels_.start(s, first_level_, s.num_levels);
  kernels_.run(s, first_level_, s.num_levels);
  kernels_.turn_back(s, 0);
  kernels_.recover(s);
  kernels_.evaluate(s, s.level_begin[first_level_], s.num_rows);
  budget_.spend(factorization_flops(s.num_taking_part, s.columns) +
                2.0 * s.unknowns * (s.columns + s.num_rows));
  ++num_sweeps_;
}

// Those that take part, or all, that aren't projected yet.
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

LexicographicSolver::Outcome LexicographicSolver::find_active_rows(bool may_descend) {
  if (budget_.is_limited()) keep_point();
  bool has_released = false;
  while (num_sweeps_ < options_.max_sweeps && !budget_.is_spent()) {
    sweep();
    const bool is_optimal = search_.is_optimal(memory_.sweep, kernels_, first_level_);
    const bool is_open = memory_.sweep.fixed < memory_.sweep.columns || search_.has_judged_norm();
    if (!is_orthonormal_ && is_open) {
      make_basis_orthonormal();
    } else if (is_optimal) {
      if (has_released || !search_.release_idle(memory_.sweep)) return Outcome::optimal;
      has_released = true;
    } else if (may_descend && (num_sweeps_ > kTries || !search_.is_nearly_optimal())) {
      may_descend = false;
      const Outcome outcome = descend();
      if (outcome != Outcome::optimal) return outcome;
    } else {
      search_.improve(memory_.sweep);
    }
  }
  if (!budget_.is_limited()) return Outcome::stuck;
  if (may_descend && !budget_.is_spent()) (void)descend();
  return Outcome::out_of_budget;
}

// Without a guess a sweep tries no limit at all. Where the leading equalities alone leave x beyond
// more than one, this is hardly ever right.
bool LexicographicSolver::begins_far_off() {
  Sweep& s = memory_.sweep;
  double square = 0.0;
  for (int i = 0; i < s.unknowns; ++i) {
    s.x[i] = s.is_identity() ? 0.0 : s.basis[i * s.stride + s.columns];
    square += s.x[i] * s.x[i];
  }
  const double rounding = tolerance::kViolated * std::sqrt(square);
  int num_beyond = 0;
  for (int k = first_level_; k < s.num_levels && num_beyond < 2; ++k) {
    const int begin = s.level_begin[k], end = s.level_begin[k + 1];
    if (begin == end || s.side[begin] == 2) continue;  // limits have levels of their own
    kernels_.evaluate(s, begin, end);
    budget_.spend(2.0 * s.unknowns * (end - begin));
    for (int row = begin; row < end; ++row) {
      const double beyond = std::max(s.value[row] - s.upper[row], s.lower[row] - s.value[row]);
      num_beyond += beyond > rounding * s.scale[row] ? 1 : 0;
    }
  }
  return num_beyond > 1;
}

// The active rows without a guess.
LexicographicSolver::Outcome LexicographicSolver::descend() {
  Sweep& s = memory_.sweep;
  project_rows(true);
  s.keep_tolerance = keep_tolerance_;
  s.smallest_pivot = smallest_pivot_;
  ++num_descents_;
  const bool has_ended = descent_.find_sides(s, kernels_, first_level_, budget_);
  if (budget_.is_limited()) keep_point();
  if (!has_ended) return budget_.is_limited() ? Outcome::out_of_budget : Outcome::stuck;
  if (is_orthonormal_ || !descent_.has_minimised_norm()) return Outcome::optimal;
  make_basis_orthonormal();
  return descend();
}

// Where the search is: at the end of the descent's last step, or where the leading equalities leave
// x. A later point replaces an earlier one only if it has finished as many levels.
void LexicographicSolver::keep_point() {
  Sweep& s = memory_.sweep;
  const int level = num_descents_ > 0 ? descent_.level() : first_level_;
  if (num_descents_ > 1 && level < kept_.level) return;
  for (int j = 0; j < s.columns; ++j) {
    s.y[j] = num_descents_ > 0 ? s.base_value[s.num_rows + j] : 0.0;
  }
  kernels_.recover(s);
  std::copy_n(s.x, s.unknowns, kept_.x.data());
  kept_.level = level;
  for (int k = first_level_; k < s.num_levels; ++k) {
    kept_.freedom_left[at(k)] = num_descents_ > 0 ? descent_.freedom_left(k) : s.columns;
  }
}

// The shortest x, where the cascade had to say that there is an optimum.
bool LexicographicSolver::polish() {
  constexpr int kSweeps = 3;
  num_sweeps_ = options_.max_sweeps - kSweeps;
  return descend() == Outcome::optimal && find_active_rows(false) == Outcome::optimal;
}

}  // namespace surefoot
