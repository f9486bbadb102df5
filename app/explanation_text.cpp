#include "app/explanation_text.hpp"

#include "app/results_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace surefoot {
namespace {

constexpr std::size_t kMostRows = 5;  // of a kind that a level shows

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
       bool is_swept)
      : levels_(levels), certificates_(certificates), is_swept_(is_swept) {}

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
      if (!certificates_.empty()) table.back().push_back(number(certificates_[k].stationarity));
    }
    return table;
  }

  [[nodiscard]] std::vector<std::string> head(std::size_t k) const {
    const LevelAccount& level = levels_[k];
    return {level_name(k),
            std::string(level.status),
            amount(level, level.residual),
            std::to_string(level.num_rows),
            std::to_string(level.held.size()),
            std::to_string(level.missed.size()),
            std::to_string(level.freedom_left),
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

  static std::string missed(const LevelAccount& level) {
    std::string text;
    for (std::size_t i = 0; i < std::min(level.missed.size(), kMostRows); ++i) {
      const MissedRow& row = level.missed[i];
      text += "      " + row.name + " is " + amount(level, std::abs(row.by)) +
              (row.by > 0.0 ? " too high\n" : " too low\n");
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
    if (level.status == "missed" && level.blocked_by.empty())
      return "   held back by nothing above: its own rows can't all be had\n";
    std::string text;
    for (const BlockingLevelAccount& by : level.blocked_by)
      text += "   held back by " + level_name(by.level) + share(level, by) + rows(level, by);
    return text;
  }

  static std::string share(const LevelAccount& level, const BlockingLevelAccount& by) {
    if (by.cost == 0.0) return " and by others, none of which costs anything alone\n";
    return ", which costs " + amount(level, by.cost) + ": without it the residual would be " +
           amount(level, std::max(0.0, level.residual - by.cost)) + "\n";
  }

  static std::string rows(const LevelAccount& level, const BlockingLevelAccount& by) {
    std::string text;
    for (std::size_t i = 0; i < std::min(by.rows.size(), kMostRows); ++i) {
      const BlockingRowAccount& row = by.rows[i];
      text += "      " + row.name + ", " + std::string(row.state) + ", alone costs " +
              amount(level, row.cost) + " (multiplier " + number(row.multiplier) + ")\n";
    }
    return text + more(by.rows.size(), "      and ", "\n");
  }

  static std::string more(std::size_t count, const std::string& before, const std::string& after) {
    return count <= kMostRows ? "" : before + std::to_string(count - kMostRows) + " more" + after;
  }

  const std::vector<LevelAccount>& levels_;
  const std::vector<LevelCertificate>& certificates_;
  bool is_swept_;
};

std::string headline(const Solution& solution) {
  const std::string unit = solution.is_swept ? " sweep" : " iteration";
  const int iterations = num_iterations(solution);
  std::string text = "status: " + std::string(name(solution.status));
  if (solution.failed_level >= 0)
    text += " in level " + std::to_string(solution.failed_level + 1) +
            "; the levels before it are optimal";
  return text + ", " + std::to_string(iterations) + unit + (iterations == 1 ? ", " : "s, ") +
         microseconds(solution.time) + "\n";
}

}  // namespace

std::string explanation_text(const std::vector<LevelAccount>& levels, const Solution& solution,
                             const std::vector<LevelCertificate>& certificates) {
  return headline(solution) + Text(levels, certificates, solution.is_swept).whole();
}

}  // namespace surefoot
