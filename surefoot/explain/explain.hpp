#pragma once

#include "surefoot/explain/level_account.hpp"
#include "surefoot/explain/tick_explanation.hpp"
#include "surefoot/solver/certificate.hpp"

#include <functional>
#include <string>
#include <vector>

// What gave way to what, and at what cost: of a tick of a log, and of a hierarchy that was solved.

namespace surefoot::explain {

/// What the rows that held a tick's levels back cost: as the control loop estimated it, or exactly.
enum class Costs { estimated, exact };

/// Explains the tick of a log next to a time [s]; its `text()` is for people, its `json()` for
/// programs. At the log's end, one period behind the last tick, that is the last tick. Exact costs
/// take about as long as a replay up to the tick: the log's controller is computed again, and what
/// `explain_solution` says of its hierarchy is told (in a blend: of those beside it). Where that
/// can't be done `why_estimates` says why, and the estimates stay. `stops` is asked at each tick
/// of the replay whether to leave it at that. Throws FileError as LogReader does, and Error, with
/// the log's range, where it has no tick at that time.
[[nodiscard]] TickExplanation explain_tick(
    const std::string& log, double time, Costs costs = Costs::exact,
    const std::function<bool()>& stops = [] { return false; });

/// Why each level of a hierarchy came out as it did.
struct SolutionExplanation {
  std::vector<LevelAccount> levels;
  solver::Solution solution;
  std::vector<solver::LevelCertificate>
      certificates;              ///< may be empty, and end where it was cut off
  bool is_budget_spent = false;  ///< why it was cut off

  /// For people: status, iterations and time, then each level with its residual, the rows that it
  /// missed or holds at a bound, and the rows above that hold it back, dearest first.
  [[nodiscard]] std::string text() const;
  /// The same, whole, for programs, as JSON. Levels are counted from 1, as in messages; costs and
  /// residuals are in the level's unit, times in seconds.
  [[nodiscard]] std::string json() const;
};

/// `solution`: of the question, and valid. What is rounding counts as 0. Takes one solve for each
/// row that may hold a level back. `progress`: see ExplainOptions.
[[nodiscard]] SolutionExplanation explain_solution(
    const config::NamedHierarchy& question, solver::Solution solution,
    const std::function<void(double)>& progress = nullptr);

/// Why an answer is not proven, or not judged: of the first level that isn't, because what is said
/// of those below hangs on it. Some level isn't proven.
[[nodiscard]] std::string verdict_text(const solver::Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                       const std::vector<solver::LevelCertificate>& levels);

}  // namespace surefoot::explain
