#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/explain/explain.hpp"
#include "surefoot/explain/gave_way.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/replay/log_replay.hpp"
#include "surefoot/solver/even_units.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::explain {
namespace {

constexpr double kResidualTolerance = 1e-6;  // of a computed residual, relative to 1 + the logged
constexpr double kHalfNanosecond = 5e-10;    // [s]

config::NamedHierarchy question_of(const control::Controller& controller) {
  const solver::Hierarchy& hierarchy = controller.hierarchy();
  const auto row_name = [&](std::size_t level, Eigen::Index row) {
    return controller.row_name(static_cast<int>(level), hierarchy.level(level).id(row));
  };
  return config::parse_hierarchy(
      config::format_hierarchy(hierarchy, row_name, controller.level_units()),
      "the tick's hierarchy");
}

/// Rows with a cost, or with an unknown one; if none costs anything alone, all rows that hold.
std::vector<CostlyRow> rows_of(const LevelAccount& level, const config::NamedHierarchy& question) {
  const auto level_name = [&](std::size_t k) { return question.hierarchy.level(k).name(); };
  std::vector<CostlyRow> rows;
  for (const BlockingLevelAccount& by : level.blocked_by) {
    for (const BlockingRowAccount& row : by.rows) {
      if (row.would_gain && row.cost == 0.0) continue;
      rows.push_back({level_name(by.level), row.name, row.cost, {}, row.is_limit});
      for (const NamedRow& same : row.same)
        rows.back().same.push_back({level_name(same.level), same.name, 0.0, {}, false});
    }
  }
  if (std::ranges::any_of(rows, [](const CostlyRow& row) { return row.cost > 0.0; }))
    std::erase_if(rows, [](const CostlyRow& row) { return row.cost == 0.0; });
  return rows;
}

/// By the levels' numbers in the header; none if the levels come out differently from the log.
std::optional<ExactCosts> costs_of(const control::Controller& controller,
                                   const logging::LogHeader& header, const TickRecord& tick,
                                   std::span<const std::int16_t> solved_by_log) {
  const config::NamedHierarchy question = question_of(controller);
  const solver::Solution solution = solver::solve_in_even_units<solver::LexicographicSolver>(
      question.hierarchy, solver::LexicographicOptions{});
  const std::vector<LevelAccount> levels = explain_solution(question, solution).levels;
  ExactCosts costs;
  for (const std::int16_t number : solved_by_log) {
    const auto own = std::ranges::find(levels, header.level_name(number), &LevelAccount::name);
    if (own == levels.end()) return std::nullopt;
    const LevelReport& logged = tick.hierarchy.levels[static_cast<std::size_t>(number)];
    const bool is_same =
        std::abs(own->residual - logged.residual) <= kResidualTolerance * (1.0 + logged.residual);
    if (!is_same || own->num_rows != logged.num_rows) return std::nullopt;
    costs[number] = rows_of(*own, question);
  }
  return costs;
}

/// A tick to compute, and where its costs go.
struct Wanted {
  const TickRecord* tick;
  const std::vector<std::int16_t>* order;
  std::optional<ExactCosts>* costs;
};

std::vector<Wanted> wanted(TickExplanation& explanation) {
  if (!logging::was_used(explanation.tick)) return {};
  if (!explanation.blend) return {{&explanation.tick, &explanation.order, &explanation.exact}};
  std::vector<Wanted> list;
  for (auto* tick : {&explanation.blend->before, &explanation.blend->after}) {
    if (*tick && logging::was_used((*tick)->tick))
      list.push_back({&(*tick)->tick, &(*tick)->order, &(*tick)->exact});
  }
  return list;
}

std::string why_not_found(const replay::LogReplay& replay, const std::string& tick) {
  if (const std::string fault = replay.controller().fault(); !fault.empty())
    return "as the log's controller is computed again, " + fault;
  if (replay.is_same()) return "solved once more, the levels of " + tick + " come out otherwise";
  const bool has_own = !replay.header().own_parts.empty();
  return "this program's controller makes another hierarchy of " + tick +
         "; the log was recorded " + (has_own ? "with other parts of the user's own, or " : "") +
         "by another version";
}

/// Fills in the costs of all of them; why not all were found, or empty.
std::string find_all(replay::LogReplay& replay, const std::vector<Wanted>& list,
                     const std::function<bool()>& stops) {
  replay.explain_levels(false);
  std::size_t found = 0;
  while (found < list.size() && replay.step()) {
    if (stops()) return "interrupted";
    const Wanted& next = list[found];
    const double time = next.tick->reading.time;
    if (replay.logged().reading.time < time - kHalfNanosecond) continue;
    *next.costs = costs_of(replay.controller(), replay.header(), *next.tick,
                           logging::solved_levels(*next.tick, *next.order));
    if (!*next.costs) {
      return why_not_found(replay, formatted("%.4f s", time));
    }
    ++found;
  }
  if (found == list.size()) return "";
  return "ticks before it are lost, so its hierarchy can't be made again";
}

/// Does nothing where no level gave way.
void find_exact_costs(TickExplanation& explanation, const std::function<bool()>& stops,
                      const tasks::OwnTasks& own) {
  const std::vector<Wanted> list = wanted(explanation);
  const bool is_asked = explanation.blend || !gave_way(explanation).empty();
  if (list.empty() || !is_asked) return;
  try {
    replay::LogReplay replay(explanation.log, {.own_tasks = own});
    explanation.why_estimates = find_all(replay, list, stops);
  } catch (const Error& error) {
    explanation.why_estimates = error.what();
  }
}

}  // namespace

TickExplanation explain_tick(const std::string& log, double time, Costs costs,
                             const std::function<bool()>& stops, const tasks::OwnTasks& own) {
  TickExplanation explanation = read_tick(log, time);
  if (costs == Costs::exact) find_exact_costs(explanation, stops, own);
  return explanation;
}

}  // namespace surefoot::explain
