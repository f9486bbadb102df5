#include "surefoot/explain/gave_way.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/explain/unused_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/visible_residual.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

namespace surefoot::explain {
namespace {

/// Two digits, or all that stand before the point: 0.12, 3.4, 460.
std::string two_digits(double value) {
  return formatted(std::abs(value) < 99.5 ? "%.2g" : "%.0f", value);
}

bool is_limit(const HierarchyReport& report, const BlockingRow& row) {
  const auto end = report.active.begin() + report.num_active;
  return std::any_of(report.active.begin(), end, [&](const ActiveRow& active) {
    return active.level == row.by_level && active.id == row.id;
  });
}

std::vector<CostlyRow> estimated_rows(const TickExplanation& explanation, std::int16_t level) {
  std::vector<CostlyRow> rows;
  const HierarchyReport& report = explanation.tick.hierarchy;
  for (std::int32_t i = 0; i < report.num_blocking; ++i) {
    const BlockingRow& row = report.blocking[static_cast<std::size_t>(i)];
    if (row.level != level) continue;
    rows.push_back({explanation.header.level_name(row.by_level),
                    row_name(explanation, row.by_level, row.id),
                    row.cost,
                    {},
                    is_limit(report, row)});
  }
  return rows;
}

/// Of a level's dearest row so much is worth telling [share], and so many rows.
constexpr double kWorthTelling = 0.1;
constexpr std::ptrdiff_t kMost = 4;

double dearest_cost(const std::vector<CostlyRow>& rows) {
  double dearest = 0.0;
  for (const CostlyRow& row : rows) {
    if (row.cost > dearest) dearest = row.cost;
  }
  return dearest;
}

// Many rows may cost a level as much, each of them nearly all of it: what the foot does and the
// limit of its leg. Of a limit one learns the most, so those that are worth telling come first; the
// dearest row is among those that are told.
std::vector<CostlyRow> rows_of(const TickExplanation& explanation, std::int16_t level) {
  std::vector<CostlyRow> rows =
      explanation.exact ? explanation.exact->at(level) : estimated_rows(explanation, level);
  const double least = kWorthTelling * dearest_cost(rows);
  const auto is_first = [&](const CostlyRow& row) { return row.is_limit && row.cost >= least; };
  std::ranges::stable_sort(rows, [&](const CostlyRow& a, const CostlyRow& b) {
    if (is_first(a) != is_first(b)) return is_first(a);
    return std::isnan(b.cost) ? !std::isnan(a.cost) : a.cost > b.cost;  // unknown ones come last
  });
  const auto dearest =
      std::ranges::find(rows, dearest_cost(rows), [](const CostlyRow& row) { return row.cost; });
  if (dearest != rows.end() && dearest - rows.begin() >= kMost)
    std::rotate(rows.begin() + kMost - 1, dearest, dearest + 1);
  return rows;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

/// A row by its level's name, without that of its own where it says no more: torso_height height.
/// `before`: the row that is told before it; its level is told once.
std::string named(const CostlyRow& row, const CostlyRow* before) {
  if (row.level.ends_with("_" + row.row)) return row.level;
  const bool is_told = before != nullptr && before->level == row.level;
  return is_told ? row.row : row.level + " " + row.row;
}

bool has_costs(const LevelThatGaveWay& level) { return dearest_cost(level.to) > kResidualRounding; }

/// Those that are worth it, at most four.
std::size_t num_told(const std::vector<CostlyRow>& rows) {
  const double dearest = dearest_cost(rows);
  const auto is_cheap = [&](const CostlyRow& row) {
    return dearest > kResidualRounding && !(row.cost >= kWorthTelling * dearest);
  };
  return static_cast<std::size_t>(
      std::min(std::ranges::find_if(rows, is_cheap) - rows.begin(), kMost));
}

bool is_same(const CostlyRow& a, const CostlyRow& b) {
  return a.level == b.level && a.row == b.row;
}

/// Of levels that nothing costs anything alone.
bool is_by_the_same(const LevelThatGaveWay& a, const LevelThatGaveWay& b) {
  return a.to.size() > 1 && !has_costs(a) && !has_costs(b) &&
         std::ranges::is_permutation(a.to, b.to, is_same);
}

/// What is known of the rows that held the levels of a tick back.
enum class Known { all, not_all, none_on_the_way };

Known known(const TickExplanation& explanation) {
  if (explanation.exact || explanation.tick.hierarchy.blocking_is_known) return Known::all;
  return explanation.blend ? Known::none_on_the_way : Known::not_all;
}

std::string to_nobody(Known known) {
  if (known == Known::none_on_the_way) return "";
  return known == Known::all ? " to nothing above: its own rows can't all be had"
                             : "; to what is not known";
}

/// " with friction_cone LF 1"; empty: no other says the same.
std::string with_same(const CostlyRow& row) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < row.same.size(); ++i)
    names.push_back(named(row.same[i], i == 0 ? &row : &row.same[i - 1]));
  return names.empty() ? "" : " with " + joined(names);
}

std::string clause(const LevelThatGaveWay& level, Known known) {
  const std::string unit = level.unit.empty() ? "" : " " + level.unit;
  std::string text = level.name + " gave way by " + two_digits(level.residual) + unit;
  if (level.to.empty()) return text + to_nobody(known);
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < level.num_told; ++i) {
    const CostlyRow& row = level.to[i];
    rows.push_back(named(row, i == 0 ? nullptr : &level.to[i - 1]) + with_same(row) +
                   (has_costs(level) ? " (" + two_digits(row.cost) + unit + ")" : ""));
  }
  const std::size_t others = level.to.size() - rows.size();
  if (others > 0) rows.push_back(std::to_string(others) + " more");
  return text + " to " + joined(rows);
}

/// What the clauses of levels leave out: that rows without a cost cost nothing alone.
std::string without_costs(const std::vector<LevelThatGaveWay>& levels) {
  const auto has_none = [](const LevelThatGaveWay& level) {
    return !level.to.empty() && !has_costs(level);
  };
  if (std::ranges::none_of(levels, has_none)) return "";
  if (levels.size() > 1) return "; rows without a number cost nothing alone";
  return levels.front().to.size() == 1 ? ", which costs nothing alone"
                                       : ", none of which costs anything alone";
}

std::string clauses(const std::vector<LevelThatGaveWay>& levels, Known known) {
  std::string text;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LevelThatGaveWay& level = levels[i];
    const std::string unit = level.unit.empty() ? "" : " " + level.unit;
    const bool goes_on = i > 0 && is_by_the_same(level, levels[i - 1]);
    text += (i == 0 ? "" : "; ") + (goes_on ? level.name + " gave way by " +
                                                  two_digits(level.residual) + unit + " to the same"
                                            : clause(level, known));
  }
  return text + without_costs(levels);
}

/// `every`: of which levels it is said.
std::string nothing_gave_way(const std::string& every,
                             const std::vector<LevelThatGaveWay>& restless) {
  if (restless.empty()) return every + " got what it asked for.";
  std::vector<std::string> names;
  names.reserve(restless.size());
  for (const LevelThatGaveWay& level : restless) names.push_back(level.name);
  return every + " got what it asked for but " + joined(names) + ", which never " +
         (names.size() == 1 ? "does." : "do.");
}

std::string without_solution(const TickRecord& tick) {
  const std::string mode(logged::kModeNames[static_cast<std::size_t>(tick.command.mode)]);
  const UnusedText text = unused_text(tick);
  return text.what + ": " + mode + ", because " + text.why + ".";
}

/// The level in which a solve was cut off; empty: it came to its end.
std::string cut_off_level(const TickExplanation& explanation) {
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  return solved < explanation.order.size()
             ? explanation.header.level_name(explanation.order[solved])
             : "";
}

/// Of the levels that are at their optimum.
std::string account(const TickExplanation& explanation, const std::string& cut_off) {
  std::vector<LevelThatGaveWay> levels = gave_way(explanation), restless;
  std::ranges::copy_if(levels, std::back_inserter(restless), &LevelThatGaveWay::restless);
  std::erase_if(levels, &LevelThatGaveWay::restless);
  if (!levels.empty()) return clauses(levels, known(explanation)) + ".";
  return nothing_gave_way(cut_off.empty() ? "Every level" : "Every level above " + cut_off,
                          restless);
}

bool has_costs(const TickExplanation& explanation) {
  return std::ranges::any_of(gave_way(explanation), [](const LevelThatGaveWay& level) {
    return !level.restless && has_costs(level);
  });
}

/// The same of a tick beside a blend, with its time; empty: the log does not have it.
std::string neighbour(const TickExplanation& explanation, const std::optional<NeighbourTick>& tick,
                      const std::string& where) {
  if (!tick) return "";
  TickExplanation beside;
  beside.header = explanation.header;
  beside.tick = tick->tick;
  beside.order = tick->order;
  beside.row_names = explanation.row_names;
  beside.exact = tick->exact;
  if (!beside.exact) beside.why_estimates = explanation.why_estimates;
  return where + formatted(" it, at %.4f s: ", tick->tick.reading.time) + beside.sentence();
}

/// "Two hierarchies are blended until 9.5700 s (order: torso_yaw from 8 to 5); …"
std::string blended(const TickExplanation& explanation) {
  const HierarchyBlend& blend = *explanation.blend;
  return "Two hierarchies are blended" +
         (std::isnan(blend.until) ? "" : formatted(" until %.4f s", blend.until)) +
         (blend.change.empty() ? "" : " (" + blend.change + ")") +
         formatted("; this tick is %.0f %% of the way, at the optimum of neither. ",
                   100.0 * explanation.tick.hierarchy.transition_share);
}

/// What came of the levels that were solved, and where a solve was cut off.
std::string outcome(const TickExplanation& explanation) {
  const std::string cut_off = cut_off_level(explanation);
  if (cut_off.empty()) return account(explanation, cut_off);
  const bool is_any_solved = !logging::solved_levels(explanation.tick, explanation.order).empty();
  return (is_any_solved ? account(explanation, cut_off) + " " : "") + "The solver was cut off in " +
         cut_off + ": of it and the levels below it nothing is known.";
}

/// Of costs that are not exact, where that was asked for.
std::string estimates(const TickExplanation& explanation) {
  if (explanation.exact || explanation.why_estimates.empty() || !has_costs(explanation)) return "";
  return " The costs are the control loop's estimates, and mostly too high: " +
         explanation.why_estimates + ".";
}

template <typename Row, std::size_t N>
std::vector<Row> of_solved_levels(const TickExplanation& explanation,
                                  const std::array<Row, N>& rows, std::int32_t count) {
  const auto solved = logging::solved_levels(explanation.tick, explanation.order);
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.begin() + count, std::back_inserter(found), [&](const Row& row) {
    return std::ranges::find(solved, row.level) != solved.end();
  });
  return found;
}

}  // namespace

std::string row_name(const TickExplanation& explanation, std::int16_t level, std::int32_t id) {
  const auto found = explanation.row_names.find({level, id});
  return found == explanation.row_names.end() ? "row " + std::to_string(id) : found->second;
}

std::vector<LevelThatGaveWay> gave_way(const TickExplanation& explanation) {
  std::vector<LevelThatGaveWay> levels;
  const HierarchyReport& report = explanation.tick.hierarchy;
  for (const std::int16_t k : logging::solved_levels(explanation.tick, explanation.order)) {
    const auto level = static_cast<std::size_t>(k);
    const double residual = report.levels[level].residual;
    const std::string name = explanation.header.level_name(k);
    const std::string unit = explanation.header.level_unit(k);
    const double visible = logging::visible_residual(name, unit);
    const bool restless = std::isnan(visible);
    if (!(residual > (restless ? kResidualRounding : visible))) continue;
    std::vector<CostlyRow> rows = rows_of(explanation, k);
    const std::size_t told = num_told(rows);
    levels.push_back({name, unit, residual, restless, std::move(rows), told});
  }
  return levels;
}

std::vector<ActiveRow> rows_at_bounds(const TickExplanation& explanation) {
  const HierarchyReport& report = explanation.tick.hierarchy;
  return of_solved_levels(explanation, report.active, report.num_active);
}

std::vector<MissedEquality> missed_rows(const TickExplanation& explanation) {
  const HierarchyReport& report = explanation.tick.hierarchy;
  return of_solved_levels(explanation, report.missed, report.num_missed);
}

logging::LevelStatus level_status(const TickExplanation& explanation, std::size_t place) {
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  if (place == solved) return logging::LevelStatus::cut_off;
  if (place > solved) return logging::LevelStatus::not_reached;
  return logging::level_status(
      explanation.tick.hierarchy.levels[static_cast<std::size_t>(explanation.order[place])]);
}

std::string TickExplanation::sentence() const {
  if (!logging::was_used(tick)) return without_solution(tick);
  if (!blend) return outcome(*this) + estimates(*this);
  return blended(*this) + outcome(*this) + neighbour(*this, blend->before, " Before") +
         neighbour(*this, blend->after, " Behind");
}

}  // namespace surefoot::explain
