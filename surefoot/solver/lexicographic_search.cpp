// Finds the active rows, by sweeps and the descent.
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
#include "surefoot/solver/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

/// Attempts to improve a guess before the search starts without one.
constexpr int kMaxTries = 2;

}  // namespace

LexicographicSolver::Outcome LexicographicSolver::find_optimum() {
  num_sweeps_ = num_descents_ = 0;
  if (options_.max_sweeps <= 0) return Outcome::stuck;
  const bool is_cold = !options_.warm_start || !has_guess_;
  const int num_exchanges = is_cold ? options_.max_exchanges : 0;
  const bool is_far_off = is_cold && num_exchanges == 0 && !budget_.is_spent() && begins_far_off();
  const Outcome outcome = is_far_off ? descend() : Outcome::optimal;
  return outcome == Outcome::optimal ? find_active_rows(!is_far_off, num_exchanges) : outcome;
}

LexicographicSolver::Outcome LexicographicSolver::find_active_rows(bool may_descend,
                                                                   int num_exchanges) {
  kept_.is_optimal = false;
  if (budget_.is_limited())
    keep_point(num_descents_ > 0 || first_level_ == memory_.sweep.num_levels);
  bool has_released = false;
  const int max_sweeps = options_.max_sweeps + num_exchanges;
  while (num_sweeps_ < max_sweeps && !budget_.is_spent()) {
    sweep();
    const bool is_optimal = search_.is_optimal(memory_.sweep, kernels_, first_level_, timer_);
    kept_.is_optimal = kept_.is_optimal && is_optimal;
    const bool is_open = memory_.sweep.fixed < memory_.sweep.columns || search_.has_judged_norm();
    if (!is_orthonormal_ && is_open) {
      make_basis_orthonormal();
    } else if (is_optimal) {
      const bool has_ended = has_released || budget_.is_spent();
      if (has_ended || !search_.release_idle(memory_.sweep)) return Outcome::optimal;
      has_released = true;
    } else if (num_sweeps_ <= num_exchanges) {
      search_.exchange(memory_.sweep);
    } else if (may_descend && (num_sweeps_ > kMaxTries || !search_.is_nearly_optimal())) {
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

void LexicographicSolver::sweep() {
  Sweep& s = memory_.sweep;
  project_rows(false);
  s.keep_tolerance = keep_tolerance_;
  s.smallest_pivot = smallest_pivot_;
  s.unused_pivot = unused_pivot_;
  kernels_.start(s, first_level_, s.num_levels);
  timer_.start();
  kernels_.run(s, first_level_, s.num_levels, timer());
  kernels_.turn_back(s, 0);
  kernels_.recover(s);
  kernels_.evaluate(s, s.level_begin[first_level_], s.num_rows);
  budget_.spend(factorization_flops(s.num_taking_part, s.columns) +
                2.0 * s.unknowns * (s.columns + s.num_rows));
  ++num_sweeps_;
}

// Without a guess a sweep starts without limits. If the leading equalities alone put x beyond more
// than one, this hardly ever succeeds.
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
    if (begin == end || s.side[begin] == 2) continue;  // limits have their own levels
    kernels_.evaluate(s, begin, end);
    budget_.spend(2.0 * s.unknowns * (end - begin));
    for (int row = begin; row < end; ++row) {
      const double beyond = std::max(s.value[row] - s.upper[row], s.lower[row] - s.value[row]);
      num_beyond += beyond > rounding * s.scale[row] ? 1 : 0;
    }
  }
  return num_beyond > 1;
}

// Finds the active rows without a guess.
LexicographicSolver::Outcome LexicographicSolver::descend() {
  Sweep& s = memory_.sweep;
  project_rows(true);
  s.keep_tolerance = keep_tolerance_;
  s.smallest_pivot = smallest_pivot_;
  s.unused_pivot = unused_pivot_;
  ++num_descents_;
  const bool has_ended = descent_.find_sides(s, kernels_, first_level_, budget_, timer_);
  if (budget_.is_limited()) keep_point(has_ended);
  if (!has_ended) return budget_.is_limited() ? Outcome::out_of_budget : Outcome::stuck;
  if (is_orthonormal_ || !descent_.has_minimised_norm()) return Outcome::optimal;
  make_basis_orthonormal();
  return descend();
}

// Keeps the current point: the end of the descent's last step, or x of the leading equalities. A
// later point replaces an earlier one only if it has finished as many levels. It is optimal if all
// levels are finished and y is the shortest, in a basis where x is, too, or has no choice.
void LexicographicSolver::keep_point(bool has_finished) {
  Sweep& s = memory_.sweep;
  const int level = num_descents_ > 0 ? descent_.level() : first_level_;
  if (num_descents_ > 1 && level < kept_.level) return;
  for (int j = 0; j < s.columns; ++j) {
    s.y[j] = num_descents_ > 0 ? s.base_value[s.num_rows + j] : 0.0;
  }
  kernels_.recover(s);
  std::copy_n(s.x, s.unknowns, kept_.x.data());
  kept_.level = level;
  const bool is_shortest = is_orthonormal_ || (num_descents_ > 0 && !descent_.has_minimised_norm());
  kept_.is_optimal = s.columns == 0 || (has_finished && is_shortest);
  for (int k = first_level_; k < s.num_levels; ++k) {
    kept_.freedom_left[at(k)] = num_descents_ > 0 ? descent_.freedom_left(k) : s.columns;
  }
}

// Finds the shortest x after the cascade has shown that an optimum exists.
bool LexicographicSolver::polish() {
  constexpr int kSweeps = 3;
  if (options_.max_sweeps <= 0) return false;
  num_sweeps_ = options_.max_sweeps - kSweeps;
  return descend() == Outcome::optimal && find_active_rows(false) == Outcome::optimal;
}

}  // namespace surefoot::solver
