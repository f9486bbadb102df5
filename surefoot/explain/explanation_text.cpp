#include "surefoot/base/formatted.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/base/text_table.hpp"
#include "surefoot/explain/explain.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::explain {
namespace {

constexpr std::size_t kMaxRows = 5;  // of a kind, that a level lists
/// Below this independence of the others a row is borderline (docs/solver.md), and its multiplier
/// means little.
constexpr double kMinIndependence = 1e-6;

std::string number(double value) { return formatted("%.4g", value); }

std::string microseconds(double seconds) { return formatted("%.1f µs", 1e6 * seconds); }

/// Unit after a space; empty without one.
std::string with_unit(const std::string& unit) { return unit.empty() ? "" : " " + printable(unit); }

std::string amount(const LevelAccount& level, double value) {
  return number(value) + with_unit(level.unit);
}

class Text {
 public:
  explicit Text(const SolutionExplanation& explanation)
      : explanation_(explanation),
        levels_(explanation.levels),
        certificates_(explanation.certificates) {}

  [[nodiscard]] std::string whole() const {
    const std::vector<std::string> lines = split(aligned(heads()));
    std::string text = lines[0];
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      text += lines[k + 1] + missed(levels_[k]) + held(levels_[k]) + held_back(levels_[k]);
    }
    return text;
  }

 private:
  using Table = std::vector<std::vector<std::string>>;

  [[nodiscard]] Table heads() const {
    Table table{{"level", "status", "residual", "rows", "at a bound", "missed", "freedom left",
                 "iterations", "time"}};
    if (!certificates_.empty()) table.front().emplace_back("certificate");
    for (std::size_t k = 0; k < levels_.size(); ++k) {
      table.push_back(head(k));
      if (certificates_.empty()) continue;
      table.back().push_back(k < certificates_.size() ? certificate(certificates_[k]) : "–");
    }
    return table;
  }

  static std::string certificate(const solver::LevelCertificate& level) {
    const solver::Verdict said = solver::verdict(level);
    return number(level.stationarity) +
           (said == solver::Verdict::proven ? "" : ", " + std::string(name(said)));
  }

  [[nodiscard]] std::vector<std::string> head(std::size_t k) const {
    const LevelAccount& level = levels_[k];
    const std::string rows = std::to_string(level.num_rows);
    if (level.status == kNotReached)
      return {level_name(k), std::string(level.status), "–", rows, "–", "–", "–", "–", "–"};
    return {level_name(k),
            std::string(level.status),
            amount(level, level.residual),
            rows,
            std::to_string(level.held.size()),
            std::to_string(level.missed.size()),
            level.status == kCutOff ? "–" : std::to_string(level.freedom_left),
            explanation_.solution.is_swept ? "–" : std::to_string(level.iterations),
            level.time > 0.0 ? microseconds(level.time) : "–"};
  }

  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin) + 1;
      lines.push_back(text.substr(begin, end - begin));
      begin = end;
    }
    return lines;
  }

  [[nodiscard]] std::string level_name(std::size_t k) const {
    const std::string number = std::to_string(k + 1);
    const std::string name = printable(levels_[k].name);
    return name == "level " + number ? name : number + " " + name;
  }

  static std::string weight(const MissedRow& row) {
    if (row.weight == 1.0) return "";
    return ", weighted " + number(row.weight) + " times: " + number(row.weight * std::abs(row.by));
  }

  static std::string missed(const LevelAccount& level) {
    std::string text;
    for (std::size_t i = 0; i < std::min(level.missed.size(), kMaxRows); ++i) {
      const MissedRow& row = level.missed[i];
      text += "      " + printable(row.name) + " is " + amount(level, std::abs(row.by)) +
              (row.by > 0.0 ? " too high" : " too low") + weight(row) + "\n";
    }
    return text + more(level.missed.size(), "      and ", "\n");
  }

  static std::string held(const LevelAccount& level) {
    if (level.held.empty()) return "";
    std::string text = "      at a bound: ";
    for (std::size_t i = 0; i < std::min(level.held.size(), kMaxRows); ++i) {
      const HeldRow& row = level.held[i];
      text += (i == 0 ? "" : ", ") + printable(row.name) + (row.at_upper ? " (upper)" : " (lower)");
    }
    return text + more(level.held.size(), " and ", "") + "\n";
  }

  [[nodiscard]] std::string held_back(const LevelAccount& level) const {
    if (level.status == kCutOff)
      return "   so far: the search ended in this level, " +
             std::string(what_ended(explanation_.is_budget_spent)) +
             ", so what holds it back is not known\n";
    if (level.status == "missed" && level.blocked_by.empty())
      return "   held back by nothing above: its own rows can't all be had\n";
    std::string text;
    for (const BlockingLevelAccount& by : level.blocked_by)
      text += "   held back by " + level_name(by.level) + share(level, by) + rows(level, by);
    return text;
  }

  /// Names of the other levels that hold `level` back.
  [[nodiscard]] std::string others(const LevelAccount& level,
                                   const BlockingLevelAccount& by) const {
    std::string names;
    for (const BlockingLevelAccount& other : level.blocked_by)
      if (other.level != by.level) names += (names.empty() ? "" : ", ") + level_name(other.level);
    return names.empty() ? "others" : names;
  }

  [[nodiscard]] std::string share(const LevelAccount& level, const BlockingLevelAccount& by) const {
    if (std::isnan(by.cost))
      return " at a cost that is not known: without it the level could not be solved\n";
    if (by.cost == 0.0) {
      const bool costs_with_others = std::ranges::any_of(
          by.rows, [](const BlockingRowAccount& row) { return row.cost > 0.0; });
      return costs_with_others
                 ? ", which costs nothing alone: other levels say the same\n"
                 : " and by " + others(level, by) + ", none of which costs anything alone\n";
    }
    return ", which costs " + amount(level, by.cost) + ": without it the residual would be " +
           amount(level, std::max(0.0, level.residual - by.cost)) + "\n";
  }

  static std::string dependence(const BlockingRowAccount& row) {
    if (row.independence >= kMinIndependence) return "";
    return ", which says little: the row is nearly dependent on others that hold, only " +
           number(row.independence) + " of its length is its own";
  }

  /// Rows that ask for the same have a cost only together.
  static std::string costs(const BlockingRowAccount& row, std::size_t level) {
    if (row.same.empty()) return ", alone costs ";
    std::string names;
    const std::size_t shown = std::min(row.same.size(), kMaxRows);
    for (std::size_t i = 0; i < shown; ++i) {
      const bool is_last = i + 1 == row.same.size();
      names += (i == 0 ? " " : (is_last ? " and " : ", ")) + printable(row.same[i].name);
      if (row.same[i].level != level) names += " of level " + std::to_string(row.same[i].level + 1);
    }
    return ", with" + names + more(row.same.size(), " and ", "") +
           (row.same.size() == 1 ? ", which says" : ", which say") + " the same, costs ";
  }

  [[nodiscard]] std::string rows(const LevelAccount& level, const BlockingLevelAccount& by) const {
    const std::string unit = with_unit(multiplier_unit(level, levels_[by.level]));
    std::string text;
    for (std::size_t i = 0; i < std::min(by.rows.size(), kMaxRows); ++i) {
      const BlockingRowAccount& row = by.rows[i];
      text += "      " + printable(row.name) + ", " + std::string(row.state);
      if (row.would_gain && row.cost == 0.0) {
        text += (by.cost == 0.0 ? ", wants the same, but keeps what it has\n"
                                : ", stops nothing: it wants the same, and others contradict it\n");
        continue;
      }
      text += costs(row, by.level) +
              (std::isnan(row.cost) ? "what is not known" : amount(level, row.cost)) +
              " (multiplier " + number(row.multiplier) + unit + dependence(row) + ")\n";
    }
    return text + more(by.rows.size(), "      and ", "\n");
  }

  static std::string more(std::size_t count, const std::string& before, const std::string& after) {
    return count <= kMaxRows ? "" : before + std::to_string(count - kMaxRows) + " more" + after;
  }

  const SolutionExplanation& explanation_;
  const std::vector<LevelAccount>& levels_;
  const std::vector<solver::LevelCertificate>& certificates_;
};

std::string headline(const SolutionExplanation& explanation) {
  const solver::Solution& solution = explanation.solution;
  const std::string unit = solution.is_swept ? " sweep" : " iteration";
  const int iterations = num_iterations(solution);
  std::string text = "status: " + std::string(name(solution.status));
  if (solution.status == solver::SolveStatus::iteration_cap)
    text += ", " + std::string(what_ended(explanation.is_budget_spent));
  const bool are_all_finished =
      solution.failed_level == static_cast<int>(explanation.levels.size());
  if (are_all_finished)
    text += "; all levels are optimal, x is not yet the shortest that they allow";
  else if (solution.failed_level >= 0)
    text += " in level " + std::to_string(solution.failed_level + 1) +
            "; the levels before it are optimal";
  if (solution.borderline) text += ", borderline: doubles can't tell which answer is the optimum";
  return text + ", " + std::to_string(iterations) + unit + (iterations == 1 ? ", " : "s, ") +
         microseconds(solution.time) + "\n";
}

}  // namespace

std::string SolutionExplanation::text() const { return headline(*this) + Text(*this).whole(); }

}  // namespace surefoot::explain
