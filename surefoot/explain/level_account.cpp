#include "surefoot/explain/explain.hpp"
#include "surefoot/solver/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace surefoot::explain {
namespace {

using Index = Eigen::Index;

constexpr double kRounding = 1e-9;  // relative
constexpr double kRoundingOfX = 100.0 * std::numeric_limits<double>::epsilon();

std::string_view words(solver::RowState state) {
  switch (state) {
    case solver::RowState::inactive:
      return "between its bounds";
    case solver::RowState::at_lower:
      return "at its lower bound";
    case solver::RowState::at_upper:
      return "at its upper bound";
    case solver::RowState::equality:
      return "an equality";
    case solver::RowState::below_lower:
      return "below its lower bound";
    case solver::RowState::above_upper:
      return "above its upper bound";
  }
  return "";
}

class Accountant {
 public:
  Accountant(const config::NamedHierarchy& question, const solver::Solution& solution)
      : question_(question), solution_(solution), reach_(reach()) {}

  /// `explanation`: null if x is not the optimum of the level.
  [[nodiscard]] LevelAccount level(std::size_t k,
                                   const solver::LevelExplanation* explanation) const {
    const solver::LevelResult& result = solution_.levels[k];
    LevelAccount account;
    account.name = question_.hierarchy.level(k).name();
    account.unit = question_.units[k];
    account.status = status(k);
    account.num_rows = result.num_rows;
    if (account.status == kNotReached) return account;
    account.freedom_left = result.degrees_of_freedom_left;
    account.iterations = result.iterations;
    account.time = result.time;
    account.missed = missed(k);
    account.held = held(k);
    if (account.missed.empty()) return account;
    account.residual = result.residual;
    if (explanation == nullptr) return account;
    account.status = kMissed;
    account.blocked_by = blocked_by(*explanation);
    return account;
  }

 private:
  /// If the level misses no row.
  [[nodiscard]] std::string_view status(std::size_t k) const {
    const std::size_t finished = num_finished(solution_, question_.hierarchy.num_levels());
    if (k > finished) return kNotReached;
    if (k == finished) return kCutOff;
    return solution_.levels[k].num_rows == 0 ? kNoRows : kMet;
  }

  /// The largest ‖x‖ that a single row at or beyond a bound asks for. Even if other rows bring x
  /// close to zero, its rounding is relative to this.
  [[nodiscard]] double reach() const {
    double farthest = solution_.x.norm();
    for (std::size_t k = 0; k < question_.hierarchy.num_levels(); ++k) {
      const solver::Level& level = question_.hierarchy.level(k);
      for (Index i = 0; i < level.num_rows(); ++i) {
        const double length = level.A().row(i).norm();
        if (length == 0.0 || state({k, i}) == solver::RowState::inactive) continue;
        for (const double bound : {level.lower()[i], level.upper()[i]})
          if (std::isfinite(bound)) farthest = std::max(farthest, std::abs(bound) / length);
      }
    }
    return farthest;
  }

  /// Positive above the upper bound, negative below the lower; 0 if it may be rounding of x.
  [[nodiscard]] double violation(std::size_t k, Index i) const {
    const solver::Level& level = question_.hierarchy.level(k);
    const double value = level.A().row(i).dot(solution_.x);
    const double lower = level.lower()[i], upper = level.upper()[i];
    const double by = std::max(0.0, value - upper) - std::max(0.0, lower - value);
    const double length = level.A().row(i).norm();
    const double rounding = std::max(kRounding * solution_.x.norm(), kRoundingOfX * reach_);
    return std::abs(by) > rounding * length ? by : 0.0;
  }

  [[nodiscard]] std::vector<MissedRow> missed(std::size_t k) const {
    std::vector<MissedRow> rows;
    for (Index i = 0; i < solution_.levels[k].num_rows; ++i) {
      const double by = violation(k, i);
      if (by != 0.0) rows.push_back({name({k, i}), by / weight({k, i}), weight({k, i})});
    }
    std::ranges::stable_sort(rows, std::ranges::greater{},
                             [](const MissedRow& row) { return row.weight * std::abs(row.by); });
    return rows;
  }

  [[nodiscard]] std::vector<HeldRow> held(std::size_t k) const {
    std::vector<HeldRow> rows;
    for (Index i = 0; i < solution_.levels[k].num_rows; ++i) {
      const solver::RowState row = state({k, i});
      if (row == solver::RowState::at_lower || row == solver::RowState::at_upper)
        rows.push_back({name({k, i}), row == solver::RowState::at_upper});
    }
    return rows;
  }

  [[nodiscard]] std::vector<BlockingLevelAccount> blocked_by(
      const solver::LevelExplanation& explanation) const {
    std::vector<BlockingLevelAccount> levels;
    for (std::size_t j = 0; j < explanation.cost_of_level.size(); ++j) {
      const double cost = explanation.cost_of_level[j];
      const bool is_rounding = cost <= kRounding * explanation.residual;
      std::vector<BlockingRowAccount> rows = blocking_rows(explanation, j);
      if (!rows.empty()) levels.push_back({j, is_rounding ? 0.0 : cost, std::move(rows)});
    }
    std::ranges::stable_sort(levels, std::ranges::greater{}, largest_cost);
    if (!levels.empty() && largest_cost(levels.front()) > 0.0)
      std::erase_if(levels,
                    [](const BlockingLevelAccount& level) { return largest_cost(level) == 0.0; });
    return levels;
  }

  /// Largest cost of the level and of its rows; −1 if there is none and one is not known.
  static double largest_cost(const BlockingLevelAccount& level) {
    double cost = std::isnan(level.cost) ? -1.0 : level.cost;
    for (const BlockingRowAccount& row : level.rows) {
      const bool is_larger = row.cost > std::max(cost, 0.0);
      if (is_larger || (std::isnan(row.cost) && cost == 0.0)) cost = is_larger ? row.cost : -1.0;
    }
    return cost;
  }

  [[nodiscard]] std::vector<BlockingRowAccount> blocking_rows(
      const solver::LevelExplanation& explanation, std::size_t level) const {
    std::vector<BlockingRowAccount> rows;
    for (const solver::DistinctBlocker& blocker : explanation.blocked_by) {
      if (blocker.at.level != level) continue;
      const bool is_rounding = blocker.cost <= kRounding * explanation.residual;
      rows.push_back({name(blocker.at), words(state(blocker.at)),
                      state(blocker.at) != solver::RowState::equality, names_of_same(blocker),
                      blocker.would_gain, is_rounding ? 0.0 : blocker.cost, blocker.multiplier,
                      blocker.independence});
    }
    return rows;
  }

  [[nodiscard]] std::vector<NamedRow> names_of_same(const solver::DistinctBlocker& blocker) const {
    std::vector<NamedRow> names;
    for (const solver::RowIndex at : blocker.same) names.push_back({at.level, name(at)});
    return names;
  }

  [[nodiscard]] double weight(solver::RowIndex at) const {
    return question_.weights[at.level][static_cast<std::size_t>(at.row)];
  }

  [[nodiscard]] const std::string& name(solver::RowIndex at) const {
    return question_.row_names[at.level][static_cast<std::size_t>(at.row)];
  }

  [[nodiscard]] solver::RowState state(solver::RowIndex at) const {
    return solution_.levels[at.level].rows[static_cast<std::size_t>(at.row)];
  }

  const config::NamedHierarchy& question_;
  const solver::Solution& solution_;
  double reach_;
};

}  // namespace

std::string multiplier_unit(const LevelAccount& level, const LevelAccount& by) {
  const auto is_one = [](const std::string& unit) {
    return !unit.empty() && unit.find(" and ") == std::string::npos;
  };
  if (!is_one(level.unit) || !is_one(by.unit)) return "";
  if (level.unit == by.unit) return level.unit;
  const auto has = [&](const char* part) { return level.unit.find(part) != std::string::npos; };
  const bool is_product = has("/") || has("^") || has(" ") || has("·") || has("²") || has("³");
  return (is_product ? "(" + level.unit + ")²" : level.unit + "²") + " per " + by.unit;
}

std::size_t num_finished(const solver::Solution& solution, std::size_t num_levels) {
  const bool is_cut_off =
      solution.status != solver::SolveStatus::optimal && solution.failed_level >= 0;
  return is_cut_off ? static_cast<std::size_t>(solution.failed_level) : num_levels;
}

SolutionExplanation explain_solution(const config::NamedHierarchy& question,
                                     solver::Solution solution,
                                     const std::function<void(double)>& progress) {
  const Accountant accountant(question, solution);
  const std::size_t num_levels = question.hierarchy.num_levels();
  const std::vector<solver::LevelExplanation> explanations =
      solver::explain(question.hierarchy, solution.x,
                      {.levels = num_finished(solution, num_levels), .progress = progress});
  SolutionExplanation explained;
  for (std::size_t k = 0; k < num_levels; ++k)
    explained.levels.push_back(
        accountant.level(k, k < explanations.size() ? &explanations[k] : nullptr));
  explained.solution = std::move(solution);
  return explained;
}

int num_iterations(const solver::Solution& solution) {
  if (solution.is_swept) return solution.levels.empty() ? 0 : solution.levels.front().iterations;
  int sum = 0;
  for (const solver::LevelResult& level : solution.levels) sum += level.iterations;
  return sum;
}

std::vector<std::size_t> levels_without_rows(const solver::Hierarchy& hierarchy) {
  std::vector<std::size_t> levels;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (hierarchy.level(k).num_rows() == 0) levels.push_back(k);
  }
  return levels;
}

std::string_view name(solver::SolveStatus status) {
  switch (status) {
    case solver::SolveStatus::optimal:
      return "optimal";
    case solver::SolveStatus::iteration_cap:
      return "iteration_cap";
    case solver::SolveStatus::invalid_input:
      return "invalid_input";
  }
  return "unknown";
}

}  // namespace surefoot::explain
