#include "surefoot/solver/lexicographic_solver.hpp"

#include "surefoot/solver/capacity.hpp"
#include "surefoot/solver/denormals.hpp"
#include "surefoot/solver/index.hpp"
#include "surefoot/solver/quiet_overflow.hpp"
#include "surefoot/solver/row_states.hpp"

#include <algorithm>

namespace surefoot::solver {
namespace {}  // namespace

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
      blockers_(capacity),
      timer_(capacity.num_levels(), options.clock),
      solution_(empty_solution(capacity)) {
  if (budget_.is_limited() && options_.max_sweeps == 0) {
    options_.max_sweeps = LexicographicOptions{}.max_sweeps;
  }
  kept_.x = Eigen::VectorXd::Zero(capacity.unknowns());
  kept_.freedom_left.assign(capacity.num_levels() + 1, 0);
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
  if (options_.clock == nullptr) return solution_;
  solution_.time = options_.clock() - start;
  if (solution_.status != SolveStatus::invalid_input) take_times(hierarchy.num_levels());
  return solution_;
}

void LexicographicSolver::solve_untimed(const Hierarchy& hierarchy,
                                        const Substitution* substitution) {
  const FlushDenormals flush_denormals;
  budget_.start();
  timer_.reset();
  is_swept_ = false;
  solution_.flops = 0.0;
  if (!fits(hierarchy, solution_) || !load(hierarchy)) return reject(hierarchy);
  if (substitution != nullptr && is_usable(*substitution)) {
    substitute(*substitution);
  } else {
    sweep_leading_equalities();
  }
  take(find_optimum(), hierarchy);
  solution_.flops = budget_.spent();
  if (!is_finite(solution_, hierarchy.num_levels())) return reject(hierarchy);
  clear_levels(solution_, hierarchy.num_levels());
  remember(hierarchy);
}

void LexicographicSolver::take_times(std::size_t num_levels) {
  for (std::size_t k = 0; k < num_levels; ++k) solution_.levels[k].time = timer_.seconds(k);
}

const std::vector<LevelBlockers>& LexicographicSolver::blockers() noexcept {
  if (is_swept_) {
    blockers_.find(memory_.sweep, kernels_, first_level_, search_);
  } else {
    blockers_.forget();
  }
  return blockers_.levels();
}

// Reads all rows; false for invalid numbers.
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
  {
    const QuietOverflow quiet;
    kernels_.measure(s);
  }
  const bool is_sound = kernels_.read_sides(s);
  int row = 0;
  while (row < s.num_rows && s.side[row] == 2) ++row;
  for (first_level_ = 0; first_level_ < s.num_levels; ++first_level_) {
    if (row < s.level_begin[first_level_ + 1]) break;
  }
  return is_sound && has_room;
}

// Keeps the active rows as the next solve's guess.
void LexicographicSolver::remember(const Hierarchy& hierarchy) {
  const Sweep& s = memory_.sweep;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    memory_of_rows_.remember(k, hierarchy.level(k), s.side + s.level_begin[k]);
  }
  memory_of_rows_.forget_from(hierarchy.num_levels());
  has_guess_ = true;
}

void LexicographicSolver::reject(const Hierarchy& hierarchy) {
  is_swept_ = false;
  num_sweeps_ = 0;
  forget();
  solver::reject(hierarchy, solution_);
}

}  // namespace surefoot::solver
