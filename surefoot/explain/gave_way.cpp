#include "surefoot/explain/gave_way.hpp"

#include "surefoot/base/formatted.hpp"
#include "surefoot/explain/unused_text.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/message_fields.hpp"

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

/// Texts name a level's costliest rows: at most `kMaxShownRows`, each with at least this share of
/// the largest cost.
constexpr double kMinShownShare = 0.1;
constexpr std::ptrdiff_t kMaxShownRows = 4;

double largest_cost(const std::vector<CostlyRow>& rows) {
  double largest = 0.0;
  for (const CostlyRow& row : rows) {
    if (row.cost > largest) largest = row.cost;
  }
  return largest;
}

// Several rows can each cost a level nearly its whole residual: the task of a foot and the limit of
// its leg. Limits explain more, so those with a large cost come first. The costliest row is always
// among the rows that texts name.
std::vector<CostlyRow> rows_of(const TickExplanation& explanation, std::int16_t level) {
  std::vector<CostlyRow> rows =
      explanation.exact ? explanation.exact->at(level) : estimated_rows(explanation, level);
  const double least = kMinShownShare * largest_cost(rows);
  const auto is_first = [&](const CostlyRow& row) { return row.is_limit && row.cost >= least; };
  std::ranges::stable_sort(rows, [&](const CostlyRow& a, const CostlyRow& b) {
    if (is_first(a) != is_first(b)) return is_first(a);
    return std::isnan(b.cost) ? !std::isnan(a.cost) : a.cost > b.cost;  // unknown ones come last
  });
  const auto costliest =
      std::ranges::find(rows, largest_cost(rows), [](const CostlyRow& row) { return row.cost; });
  if (costliest != rows.end() && costliest - rows.begin() >= kMaxShownRows)
    std::rotate(rows.begin() + kMaxShownRows - 1, costliest, costliest + 1);
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

/// Level and row: "swing_foot LF x". The level alone where its name ends with the row's
/// (torso_height height); the row alone where `before`, the row named before it, is of its level.
std::string named(const CostlyRow& row, const CostlyRow* before) {
  if (row.level.ends_with("_" + row.row)) return row.level;
  const bool is_level_named = before != nullptr && before->level == row.level;
  return is_level_named ? row.row : row.level + " " + row.row;
}

bool has_costs(const LevelThatGaveWay& level) { return largest_cost(level.to) > kResidualRounding; }

/// How many rows texts name.
std::size_t num_shown(const std::vector<CostlyRow>& rows) {
  const double largest = largest_cost(rows);
  const auto is_cheap = [&](const CostlyRow& row) {
    return largest > kResidualRounding && !(row.cost >= kMinShownShare * largest);
  };
  return static_cast<std::size_t>(
      std::min(std::ranges::find_if(rows, is_cheap) - rows.begin(), kMaxShownRows));
}

bool is_same(const CostlyRow& a, const CostlyRow& b) {
  return a.level == b.level && a.row == b.row;
}

/// The same rows hold both levels back, and none of them costs anything alone.
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

/// " with friction_cone LF 1": rows that ask for the same; empty if there are none.
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
  for (std::size_t i = 0; i < level.num_shown; ++i) {
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

/// `every`: the levels that it is about, e.g. "Every level".
std::string nothing_gave_way(const std::string& every,
                             const std::vector<LevelThatGaveWay>& minimised) {
  if (minimised.empty()) return every + " got what it asked for.";
  std::vector<std::string> names;
  names.reserve(minimised.size());
  for (const LevelThatGaveWay& level : minimised) names.push_back(level.name);
  return every + " got what it asked for but " + joined(names) + ", which never " +
         (names.size() == 1 ? "does." : "do.");
}

std::string without_solution(const TickExplanation& explanation) {
  const TickRecord& tick = explanation.tick;
  const std::string mode(logged::kModeNames[static_cast<std::size_t>(tick.command.mode)]);
  const UnusedText text = unused_text(tick, explanation.header.robot.joints());
  return text.what + ": " + mode + ", because " + text.why + ".";
}

/// The level in which a solve was cut off; empty if it was not.
std::string cut_off_level(const TickExplanation& explanation) {
  const std::size_t solved = logging::solved_levels(explanation.tick, explanation.order).size();
  return solved < explanation.order.size()
             ? explanation.header.level_name(explanation.order[solved])
             : "";
}

/// What the levels at their optimum gave way to.
std::string account(const TickExplanation& explanation, const std::string& cut_off) {
  std::vector<LevelThatGaveWay> levels = gave_way(explanation), minimised;
  std::ranges::copy_if(levels, std::back_inserter(minimised), &LevelThatGaveWay::is_minimised);
  std::erase_if(levels, &LevelThatGaveWay::is_minimised);
  if (!levels.empty()) return clauses(levels, known(explanation)) + ".";
  return nothing_gave_way(cut_off.empty() ? "Every level" : "Every level above " + cut_off,
                          minimised);
}

bool has_costs(const TickExplanation& explanation) {
  return std::ranges::any_of(gave_way(explanation), [](const LevelThatGaveWay& level) {
    return !level.is_minimised && has_costs(level);
  });
}

/// The sentence of the tick before or after a blend, with its time; empty if the log lacks it.
std::string neighbour_text(const TickExplanation& explanation,
                           const std::optional<NeighbourTick>& tick, const std::string& where) {
  if (!tick) return "";
  TickExplanation neighbour;
  neighbour.header = explanation.header;
  neighbour.tick = tick->tick;
  neighbour.order = tick->order;
  neighbour.row_names = explanation.row_names;
  neighbour.exact = tick->exact;
  if (!neighbour.exact) neighbour.why_estimates = explanation.why_estimates;
  return where + formatted(" it, at %.4f s: ", tick->tick.reading.time) + neighbour.sentence();
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

/// What the solved levels gave way to, and where a solve was cut off.
std::string outcome(const TickExplanation& explanation) {
  const std::string cut_off = cut_off_level(explanation);
  if (cut_off.empty()) return account(explanation, cut_off);
  const bool is_any_solved = !logging::solved_levels(explanation.tick, explanation.order).empty();
  return (is_any_solved ? account(explanation, cut_off) + " " : "") + "The solver was cut off in " +
         cut_off + ": of it and the levels below it nothing is known.";
}

/// That the costs are not exact, and why, where exact ones were asked for.
std::string estimates(const TickExplanation& explanation) {
  if (explanation.exact || !has_costs(explanation)) return "";
  const std::string& why = explanation.why_estimates;
  return " The costs are the control loop's estimates, and mostly too high" +
         (why.empty() ? "" : ": " + why) + ".";
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
    const double visible = explanation.header.visible(k);
    const bool is_minimised = std::isnan(visible);
    if (!(residual > (is_minimised ? kResidualRounding : visible))) continue;
    std::vector<CostlyRow> rows = rows_of(explanation, k);
    const std::size_t shown = num_shown(rows);
    levels.push_back({name, unit, residual, is_minimised, std::move(rows), shown});
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
  if (!logging::was_used(tick)) return without_solution(*this);
  if (!blend) return outcome(*this) + estimates(*this);
  return blended(*this) + outcome(*this) + neighbour_text(*this, blend->before, " Before") +
         neighbour_text(*this, blend->after, " Behind");
}

}  // namespace surefoot::explain
