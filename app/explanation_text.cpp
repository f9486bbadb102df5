#include "app/explanation_text.hpp"

#include "app/results_table.hpp"
#include "surefoot/solver/explanation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

namespace surefoot {
namespace {

using Index = Eigen::Index;

constexpr double kNothing = 1e-9;     // shown as 0
constexpr std::size_t kMostRows = 5;  // of a kind that a level shows

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", std::abs(value) < kNothing ? 0.0 : value);
  return text.data();
}

const char* words(RowState state) {
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

class Text {
 public:
  Text(const NamedHierarchy& question, const Solution& solution)
      : question_(question), solution_(solution) {}

  std::string whole() {
    std::vector<std::vector<std::string>> heads{
        {"level", "residual", "rows", "at or beyond a bound", "freedom left"}};
    const auto explanations = explain(question_.hierarchy, solution_.x);
    for (std::size_t k = 0; k < explanations.size(); ++k) heads.push_back(head(k));
    const std::vector<std::string> lines = split(aligned(heads));
    std::string text = lines[0];
    for (std::size_t k = 0; k < explanations.size(); ++k) {
      text += lines[k + 1] + missed(k) + held_back(explanations[k]);
    }
    return text;
  }

 private:
  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = text.find('\n', begin) + 1;
      lines.push_back(text.substr(begin, end - begin));
      begin = end;
    }
    return lines;
  }

  static std::string more(std::size_t number) {
    return number == 0 ? "" : "      and " + std::to_string(number) + " more\n";
  }

  [[nodiscard]] std::string level_name(std::size_t k) const {
    return std::to_string(k + 1) + " " + question_.hierarchy.level(k).name();
  }

  [[nodiscard]] std::vector<std::string> head(std::size_t k) const {
    const LevelResult& result = solution_.levels[k];
    return {level_name(k), number(result.residual), std::to_string(result.num_rows),
            std::to_string(result.num_active()), std::to_string(result.degrees_of_freedom_left)};
  }

  /// Signed: positive above the upper bound.
  [[nodiscard]] double violation(std::size_t k, Index i) const {
    const Level& level = question_.hierarchy.level(k);
    const double value = level.A().row(i).dot(solution_.x);
    return std::max(0.0, value - level.upper()[i]) - std::max(0.0, level.lower()[i] - value);
  }

  [[nodiscard]] std::string missed(std::size_t k) const {
    std::vector<Index> rows;
    for (Index i = 0; i < solution_.levels[k].num_rows; ++i) {
      if (std::abs(violation(k, i)) > kNothing) rows.push_back(i);
    }
    std::ranges::stable_sort(rows, std::ranges::greater{},
                             [&](Index i) { return std::abs(violation(k, i)); });
    std::string text;
    for (std::size_t n = 0; n < std::min(rows.size(), kMostRows); ++n) {
      const double by = violation(k, rows[n]);
      text += "      " + name({k, rows[n]}) + " is " + number(std::abs(by)) +
              (by > 0.0 ? " too high\n" : " too low\n");
    }
    return text + more(rows.size() - std::min(rows.size(), kMostRows));
  }

  [[nodiscard]] std::string held_back(const LevelExplanation& level) const {
    std::string text;
    for (std::size_t j = 0; j < level.cost_of_level.size(); ++j) {
      if (level.cost_of_level[j] > kNothing) text += held_back_by(level, j);
    }
    return text;
  }

  [[nodiscard]] std::string held_back_by(const LevelExplanation& level, std::size_t j) const {
    std::string text = "   held back by " + level_name(j) + ": without it the residual would be " +
                       number(level.residual - level.cost_of_level[j]) + "\n";
    std::size_t shown = 0;
    std::size_t hidden = 0;
    for (const Blocker& blocker : level.blocked_by) {
      if (blocker.at.level != j) continue;
      if (shown == kMostRows) {
        ++hidden;
        continue;
      }
      ++shown;
      text += "      " + name(blocker.at) + ", " + words(state(blocker.at)) + ", costs " +
              number(blocker.cost) + " (multiplier " + number(blocker.multiplier) + ")\n";
    }
    return text + more(hidden);
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

std::string explanation_text(const NamedHierarchy& question, const Solution& solution) {
  return Text(question, solution).whole();
}

}  // namespace surefoot
