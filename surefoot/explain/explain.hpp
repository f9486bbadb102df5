#pragma once

#include "surefoot/explain/level_account.hpp"
#include "surefoot/explain/tick_explanation.hpp"
#include "surefoot/solver/certificate.hpp"

#include <functional>
#include <string>
#include <vector>

// What gave way to what, and at what cost: in a tick of a log, and in a solved hierarchy.

namespace surefoot::explain {

/// Costs of the rows that held a tick's levels back: the control loop's estimates, or exact.
enum class Costs { estimated, exact };

/// Explains the tick of a log nearest to a time [s], as `read_tick` finds it. Exact costs come from
/// `explain_solution` for the tick's hierarchy (in a blend: for those of the ticks before and after
/// it). For this the log's controller is computed again, which takes about as long as a replay up
/// to the tick. If that is not possible, the estimates stay and `why_estimates` says why. `stops`
/// is called at each tick of the replay; true ends it. `own`: the user's tasks of the run. Throws
/// as `read_tick`.
[[nodiscard]] TickExplanation explain_tick(
    const std::string& log, double time, Costs costs = Costs::exact,
    const std::function<bool()>& stops = [] { return false; }, const tasks::OwnTasks& own = {});

/// Why each level of a hierarchy came out as it did.
struct SolutionExplanation {
  std::vector<LevelAccount> levels;
  solver::Solution solution;
  /// By level; empty if not asked for. Ends before the level that was cut off.
  std::vector<solver::LevelCertificate> certificates;
  bool is_budget_spent = false;  ///< the budget cut the search off, not the solver's own cap

  /// For people: status, iterations and time, then each level with its residual, the rows that it
  /// missed or holds at a bound, and the rows above that hold it back, costliest first.
  [[nodiscard]] std::string text() const;
  /// The same, whole, for programs, as JSON. Levels are counted from 1, as in messages; costs and
  /// residuals are in the level's unit, times in seconds.
  [[nodiscard]] std::string json() const;
};

/// `solution`: of the question, and valid. Costs within rounding are 0. Needs one solve for each
/// row that may hold a level back. `progress`: see ExplainOptions.
[[nodiscard]] SolutionExplanation explain_solution(
    const config::NamedHierarchy& question, solver::Solution solution,
    const std::function<void(double)>& progress = nullptr);

/// Why an answer is not proven, or not judged: about the first such level, because the verdicts
/// below depend on it. At least one level must be unproven.
[[nodiscard]] std::string verdict_text(const solver::Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                       const std::vector<solver::LevelCertificate>& levels);

}  // namespace surefoot::explain
