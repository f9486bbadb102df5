#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/solver/hierarchy.hpp"
#include "surefoot/solver/solution.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::python {

namespace nb = nanobind;

/// How one level of a hierarchy came out; `Level` in Python.
struct LevelOutcome {
  std::string name;
  LevelReport report;
  std::vector<std::pair<std::string, std::string>> active;  ///< row, state
  std::optional<double> certificate;                        ///< none: not asked for
  std::optional<std::string> verdict;
  std::optional<int> rests_on = std::nullopt;  ///< `LevelCertificate::rests_on`
};

inline std::string state_name(solver::RowState state) {
  switch (state) {
    case solver::RowState::below_lower:
      return "below lower";
    case solver::RowState::at_lower:
      return "at lower";
    case solver::RowState::at_upper:
      return "at upper";
    case solver::RowState::above_upper:
      return "above upper";
    case solver::RowState::inactive:
    case solver::RowState::equality:
      break;
  }
  return "";
}

/// Of a controller's stack.
struct StackNames {
  std::vector<std::string> levels;
  std::vector<std::vector<std::string>> rows;  ///< by level and id
};

/// The levels of a controller at its last tick, with the names that its stack had then.
inline std::vector<LevelOutcome> outcomes(const control::Controller& controller,
                                          const StackNames& names) {
  const HierarchyReport& report = controller.record().hierarchy;
  std::vector<LevelOutcome> levels;
  for (std::size_t k = 0; k < static_cast<std::size_t>(report.num_levels); ++k) {
    levels.push_back({.name = names.levels[k],
                      .report = report.levels[k],
                      .active = {},
                      .certificate = {},
                      .verdict = {}});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(report.num_active); ++i) {
    const ActiveRow& row = report.active[i];
    levels[static_cast<std::size_t>(row.level)].active.emplace_back(
        names.rows[static_cast<std::size_t>(row.level)][static_cast<std::size_t>(row.id)],
        state_name(static_cast<solver::RowState>(row.state)));
  }
  return levels;
}

/// A level that was solved by itself; `row_names` by row.
inline LevelOutcome outcome(const std::string& name, const solver::LevelResult& result,
                            const std::vector<std::string>& row_names) {
  LevelOutcome level{.name = name, .report = {}, .active = {}, .certificate = {}, .verdict = {}};
  level.report.residual = result.residual;
  level.report.degrees_of_freedom_left = static_cast<int>(result.degrees_of_freedom_left);
  level.report.iterations = result.iterations;
  level.report.num_rows = static_cast<int>(result.num_rows);
  level.report.num_active = result.num_active();
  for (std::size_t i = 0; i < row_names.size(); ++i) {
    const std::string state = state_name(result.rows[i]);
    if (!state.empty()) level.active.emplace_back(row_names[i], state);
  }
  return level;
}

}  // namespace surefoot::python
