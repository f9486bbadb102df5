#include "surefoot/view/report_blockers.hpp"

#include "surefoot/view/report_page.hpp"
#include "surefoot/view/svg.hpp"

#include <algorithm>

namespace surefoot::report {
namespace {

constexpr std::size_t kMostRows = 4;  // of a level

std::string level_name(const RunData& run, std::int16_t level) {
  std::string name = run.header.level_name(level);
  std::ranges::replace(name, '_', ' ');
  return std::to_string(level + 1) + "  " + name;
}

std::string row_name(const RunData& run, const GaveWay& row) {
  const auto found = run.row_names.find({row.by_level, row.id});
  return found == run.row_names.end() ? "row " + std::to_string(row.id) : found->second;
}

std::string amount(const RunData& run, const GaveWay& row) {
  const std::string unit = run.header.level_unit(row.level);
  return plot::two_digits(row.largest) + (unit.empty() ? "" : " " + unit);
}

std::vector<Cell> cells(const RunData& run, const GaveWay& row, bool is_first) {
  const double seconds = row.num_ticks * run.header.control_period;
  const double share = 100.0 * row.num_ticks / run.num_explained_ticks;
  return {{is_first ? level_name(run, row.level) : ""},
          {level_name(run, row.by_level) + ": " + row_name(run, row)},
          {plot::decimal(seconds, 2) + " s", "number"},
          {share < 0.1 ? "< 0.1 %" : plot::decimal(share, 1) + " %", "number"},
          {amount(run, row), "number"},
          {plot::decimal(row.time, 2) + " s", "number"}};
}

std::vector<Cell> hidden(std::size_t count) {
  return {{""},
          {"and " + std::to_string(count) + (count == 1 ? " row" : " rows") + " that cost less",
           "soft"},
          {""},
          {""},
          {""},
          {""}};
}

void add_level(const RunData& run, std::vector<GaveWay> rows,
               std::vector<std::vector<Cell>>& table) {
  std::ranges::stable_sort(rows, std::ranges::greater{}, &GaveWay::sum);
  const std::size_t shown =
      rows.size() == kMostRows + 1 ? rows.size() : std::min(rows.size(), kMostRows);
  for (std::size_t i = 0; i < shown; ++i) table.push_back(cells(run, rows[i], i == 0));
  if (shown < rows.size()) table.push_back(hidden(rows.size() - shown));
}

std::string note(const RunData& run) {
  const double share = 100.0 * run.num_explained_ticks / static_cast<double>(run.ticks.size());
  std::string text =
      "Rows of higher levels that kept a level from what it asked for, dearest over the run first. "
      "The cost is what the level's residual would fall by if that row alone gave way, as the "
      "control loop estimates it: mostly too much, and 0 where it can't say. "
      "<code>surefoot explain</code> tells the exact ones of a recorded run's tick.";
  if (run.num_explained_ticks < static_cast<int>(run.ticks.size()))
    text += " Known at " + plot::decimal(share, 1) + " % of the ticks, of which the shares are.";
  return "<p class=\"soft\">" + text + "</p>\n";
}

}  // namespace

std::string blocker_table(const RunData& run) {
  if (run.num_explained_ticks == 0) return "";
  const std::string head = "<h3>What gave way to what</h3>\n";
  if (run.gave_way.empty())
    return head + "<p class=\"soft\">No level was held back by a row above it.</p>\n";
  std::vector<std::vector<Cell>> table_rows;
  for (auto first = run.gave_way.begin(); first != run.gave_way.end();) {
    const auto end = std::find_if(first, run.gave_way.end(),
                                  [&](const GaveWay& row) { return row.level != first->level; });
    add_level(run, {first, end}, table_rows);
    first = end;
  }
  return head + note(run) +
         table({"level", "gave way to", "for", "of the ticks", "largest cost", "at"}, table_rows);
}

}  // namespace surefoot::report
