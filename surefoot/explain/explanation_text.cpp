#include "surefoot/explain/explanation_text.hpp"

#include "surefoot/base/printable.hpp"
#include "surefoot/base/text_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace surefoot {
namespace {

constexpr std::size_t kMostRows = 5;  // of a kind that a level shows
/// Rows of which less is left beside the others are borderline (docs/solver.md): their multipliers
/// are no prices.
constexpr double kNearlyDependent = 1e-6;

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string microseconds(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f µs", 1e6 * seconds);
  return text.data();
}

class Text {
 public:
  Text(const std::vector<LevelAccount>& levels, const std::vector<LevelCertificate>& certificates,
       bool is_swept, std::string_view ended_by)
      : levels_(levels), certificates_(certificates), is_swept_(is_swept), ended_by_(ended_by) {}

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

  static std::string certificate(const LevelCertificate& level) {
    const Verdict said = verdict(level);
    return number(level.stationarity) +
           (said == Verdict::proven ? "" : ", " + std::string(name(said)));
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
            is_swept_ ? "–" : std::to_string(level.iterations),
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
    const std::string& name = levels_[k].name;
    return name == "level " + number ? name : number + " " + name;
  }

  static std::string amount(const LevelAccount& level, double value) {
    return number(value) + (level.unit.empty() ? "" : " " + level.unit);
  }

  static std::string weight(const MissedRow& row) {
    if (row.weight == 1.0) return "";
    return ", weighted " + number(row.weight) + " times: " + number(row.weight * std::abs(row.by));
  }

  static std::string missed(const LevelAccount& level) {
    std::string text;
    for (std::size_t i = 0; i < std::min(level.missed.size(), kMostRows); ++i) {
      const MissedRow& row = level.missed[i];
      text += "      " + row.name + " is " + amount(level, std::abs(row.by)) +
              (row.by > 0.0 ? " too high" : " too low") + weight(row) + "\n";
    }
    return text + more(level.missed.size(), "      and ", "\n");
  }

  static std::string held(const LevelAccount& level) {
    if (level.held.empty()) return "";
    std::string text = "      at a bound: ";
    for (std::size_t i = 0; i < std::min(level.held.size(), kMostRows); ++i) {
      const HeldRow& row = level.held[i];
      text += (i == 0 ? "" : ", ") + row.name + (row.at_upper ? " (upper)" : " (lower)");
    }
    return text + more(level.held.size(), " and ", "") + "\n";
  }

  [[nodiscard]] std::string held_back(const LevelAccount& level) const {
    if (level.status == kCutOff)
      return "   so far: the search ended in this level, " + std::string(ended_by_) +
             ", so what holds it back is not known\n";
    if (level.status == "missed" && level.blocked_by.empty())
      return "   held back by nothing above: its own rows can't all be had\n";
    std::string text;
    for (const BlockingLevelAccount& by : level.blocked_by)
      text += "   held back by " + level_name(by.level) + share(level, by) + rows(level, by);
    return text;
  }

  /// Of the levels beside `by` that hold the same.
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
      const bool is_said_again = std::ranges::any_of(
          by.rows, [](const BlockingRowAccount& row) { return row.cost > 0.0; });
      return is_said_again
                 ? ", which costs nothing alone: other levels say the same\n"
                 : " and by " + others(level, by) + ", none of which costs anything alone\n";
    }
    return ", which costs " + amount(level, by.cost) + ": without it the residual would be " +
           amount(level, std::max(0.0, level.residual - by.cost)) + "\n";
  }

  static std::string dependence(const BlockingRowAccount& row) {
    if (row.independence >= kNearlyDependent) return "";
    return ", which says little: the row is nearly dependent on others that hold, only " +
           number(row.independence) + " of its length is its own";
  }

  /// Rows that say the same have a cost only together.
  static std::string costs(const BlockingRowAccount& row, std::size_t level) {
    if (row.same.empty()) return ", alone costs ";
    std::string names;
    const std::size_t shown = std::min(row.same.size(), kMostRows);
    for (std::size_t i = 0; i < shown; ++i) {
      const bool is_last = i + 1 == row.same.size();
      names += (i == 0 ? " " : (is_last ? " and " : ", ")) + row.same[i].name;
      if (row.same[i].level != level) names += " of level " + std::to_string(row.same[i].level + 1);
    }
    return ", with" + names + more(row.same.size(), " and ", "") +
           (row.same.size() == 1 ? ", which says" : ", which say") + " the same, costs ";
  }

  [[nodiscard]] std::string rows(const LevelAccount& level, const BlockingLevelAccount& by) const {
    const std::string unit = multiplier_unit(level, levels_[by.level]);
    std::string text;
    for (std::size_t i = 0; i < std::min(by.rows.size(), kMostRows); ++i) {
      const BlockingRowAccount& row = by.rows[i];
      if (row.would_gain && row.cost == 0.0) {
        text += "      " + row.name + ", " + std::string(row.state) +
                (by.cost == 0.0 ? ", wants the same, but keeps what it has\n"
                                : ", stops nothing: it wants the same, and others contradict it\n");
        continue;
      }
      text += "      " + row.name + ", " + std::string(row.state) + costs(row, by.level) +
              (std::isnan(row.cost) ? "what is not known" : amount(level, row.cost)) +
              " (multiplier " + number(row.multiplier) + (unit.empty() ? "" : " " + unit) +
              dependence(row) + ")\n";
    }
    return text + more(by.rows.size(), "      and ", "\n");
  }

  static std::string more(std::size_t count, const std::string& before, const std::string& after) {
    return count <= kMostRows ? "" : before + std::to_string(count - kMostRows) + " more" + after;
  }

  const std::vector<LevelAccount>& levels_;
  const std::vector<LevelCertificate>& certificates_;
  bool is_swept_;
  std::string_view ended_by_;
};

std::string headline(const Solution& solution, std::size_t num_levels, std::string_view ended_by) {
  const std::string unit = solution.is_swept ? " sweep" : " iteration";
  const int iterations = num_iterations(solution);
  std::string text = "status: " + std::string(name(solution.status));
  if (solution.status == SolveStatus::iteration_cap) text += ", " + std::string(ended_by);
  const bool are_all_finished = solution.failed_level == static_cast<int>(num_levels);
  if (are_all_finished)
    text += "; all levels are optimal, x is not yet the shortest that they allow";
  else if (solution.failed_level >= 0)
    text += " in level " + std::to_string(solution.failed_level + 1) +
            "; the levels before it are optimal";
  if (solution.borderline) text += ", borderline: doubles can't tell which answer is the optimum";
  return text + ", " + std::to_string(iterations) + unit + (iterations == 1 ? ", " : "s, ") +
         microseconds(solution.time) + "\n";
}

/// The same, with names as a terminal may show them.
std::vector<LevelAccount> with_printable_names(std::vector<LevelAccount> levels) {
  for (LevelAccount& level : levels) {
    level.name = printable(level.name);
    level.unit = printable(level.unit);
    for (MissedRow& row : level.missed) row.name = printable(row.name);
    for (HeldRow& row : level.held) row.name = printable(row.name);
    for (BlockingLevelAccount& by : level.blocked_by) {
      for (BlockingRowAccount& row : by.rows) {
        row.name = printable(row.name);
        for (NamedRow& same : row.same) same.name = printable(same.name);
      }
    }
  }
  return levels;
}

}  // namespace

std::string explanation_text(const std::vector<LevelAccount>& levels, const Solution& solution,
                             const std::vector<LevelCertificate>& certificates,
                             bool is_budget_spent) {
  const std::vector<LevelAccount> named = with_printable_names(levels);
  const std::string_view ended_by = what_ended(is_budget_spent);
  return headline(solution, levels.size(), ended_by) +
         Text(named, certificates, solution.is_swept, ended_by).whole();
}

}  // namespace surefoot
