#include "app/level_account.hpp"

#include "surefoot/solver/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot {
namespace {

using Index = Eigen::Index;

constexpr double kRounding = 1e-9;  // relative

std::string_view words(RowState state) {
  switch (state) {
    case RowState::inactive:
      return "between its bounds";
    case RowState::at_lower:
      return "at its lower bound";
    case RowState::at_upper:
      return "at its upper bound";
    case RowState::equality:
      return "an equality";
    case RowState::below_lower:
      return "below its lower bound";
    case RowState::above_upper:
      return "above its upper bound";
  }
  return "";
}

class Accountant {
 public:
  Accountant(const NamedHierarchy& question, const Solution& solution)
      : question_(question), solution_(solution) {}

  [[nodiscard]] LevelAccount level(std::size_t k, const LevelExplanation& explanation) const {
    const LevelResult& result = solution_.levels[k];
    LevelAccount account{.name = question_.hierarchy.level(k).name(),
                         .unit = question_.units[k],
                         .status = "",
                         .residual = result.residual,
                         .num_rows = result.num_rows,
                         .freedom_left = result.degrees_of_freedom_left,
                         .iterations = result.iterations,
                         .time = result.time,
                         .missed = missed(k),
                         .held = held(k),
                         .blocked_by = {}};
    if (account.missed.empty()) {
      account.residual = 0.0;
    } else {
      account.blocked_by = blocked_by(explanation);
    }
    account.status = status(k, account.missed.empty());
    return account;
  }

 private:
  [[nodiscard]] std::string_view status(std::size_t k, bool is_met) const {
    const int level = static_cast<int>(k);
    const int failed = solution_.status == SolveStatus::optimal ? -1 : solution_.failed_level;
    if (solution_.levels[k].num_rows == 0) return "no rows";
    if (failed >= 0 && level == failed) return "cut off";
    if (failed >= 0 && level > failed) return "not solved";
    return is_met ? "met" : "missed";
  }

  /// Signed: positive above the upper bound.
  [[nodiscard]] double violation(std::size_t k, Index i) const {
    const Level& level = question_.hierarchy.level(k);
    const double value = level.A().row(i).dot(solution_.x);
    const double lower = level.lower()[i], upper = level.upper()[i];
    const double by = std::max(0.0, value - upper) - std::max(0.0, lower - value);
    const double size = level.A().row(i).norm() * solution_.x.norm();
    return std::abs(by) > kRounding * size ? by : 0.0;
  }

  [[nodiscard]] std::vector<MissedRow> missed(std::size_t k) const {
    std::vector<MissedRow> rows;
    for (Index i = 0; i < solution_.levels[k].num_rows; ++i) {
      const double by = violation(k, i);
      if (by != 0.0) rows.push_back({name({k, i}), by});
    }
    std::ranges::stable_sort(rows, std::ranges::greater{},
                             [](const MissedRow& row) { return std::abs(row.by); });
    return rows;
  }

  [[nodiscard]] std::vector<HeldRow> held(std::size_t k) const {
    std::vector<HeldRow> rows;
    for (Index i = 0; i < solution_.levels[k].num_rows; ++i) {
      const RowState row = state({k, i});
      if (row == RowState::at_lower || row == RowState::at_upper)
        rows.push_back({name({k, i}), row == RowState::at_upper});
    }
    return rows;
  }

  [[nodiscard]] std::vector<BlockingLevelAccount> blocked_by(
      const LevelExplanation& explanation) const {
    std::vector<BlockingLevelAccount> levels;
    for (std::size_t j = 0; j < explanation.cost_of_level.size(); ++j) {
      const double cost = explanation.cost_of_level[j];
      const bool is_rounding = cost <= kRounding * explanation.residual;
      std::vector<BlockingRowAccount> rows = blocking_rows(explanation, j);
      if (!rows.empty()) levels.push_back({j, is_rounding ? 0.0 : cost, std::move(rows)});
    }
    std::ranges::stable_sort(levels, std::ranges::greater{}, &BlockingLevelAccount::cost);
    if (!levels.empty() && levels.front().cost > 0.0)
      std::erase_if(levels, [](const BlockingLevelAccount& level) { return level.cost == 0.0; });
    return levels;
  }

  [[nodiscard]] std::vector<BlockingRowAccount> blocking_rows(const LevelExplanation& explanation,
                                                              std::size_t level) const {
    std::vector<BlockingRowAccount> rows;
    for (const Blocker& blocker : explanation.blocked_by) {
      if (blocker.at.level != level) continue;
      const bool is_rounding = blocker.cost <= kRounding * explanation.residual;
      rows.push_back({name(blocker.at), words(state(blocker.at)), is_rounding ? 0.0 : blocker.cost,
                      blocker.multiplier});
    }
    return rows;
  }

  [[nodiscard]] const std::string& name(RowIndex at) const {
    return question_.row_names[at.level][static_cast<std::size_t>(at.row)];
  }

  [[nodiscard]] RowState state(RowIndex at) const {
    return solution_.levels[at.level].rows[static_cast<std::size_t>(at.row)];
  }

  const NamedHierarchy& question_;
  const Solution& solution_;
};

}  // namespace

std::vector<LevelAccount> account_for(const NamedHierarchy& question, const Solution& solution) {
  const Accountant accountant(question, solution);
  const std::vector<LevelExplanation> explanations = explain(question.hierarchy, solution.x);
  std::vector<LevelAccount> accounts;
  for (std::size_t k = 0; k < explanations.size(); ++k) {
    accounts.push_back(accountant.level(k, explanations[k]));
  }
  return accounts;
}

int num_iterations(const Solution& solution) {
  if (solution.is_swept) return solution.levels.empty() ? 0 : solution.levels.front().iterations;
  int sum = 0;
  for (const LevelResult& level : solution.levels) sum += level.iterations;
  return sum;
}

std::vector<std::size_t> levels_without_rows(const Hierarchy& hierarchy) {
  std::vector<std::size_t> levels;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (hierarchy.level(k).num_rows() == 0) levels.push_back(k);
  }
  return levels;
}

std::string_view name(SolveStatus status) {
  switch (status) {
    case SolveStatus::optimal:
      return "optimal";
    case SolveStatus::iteration_cap:
      return "iteration_cap";
    case SolveStatus::invalid_input:
      return "invalid_input";
  }
  return "unknown";
}

}  // namespace surefoot
