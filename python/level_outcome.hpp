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

/// The levels of a controller at its last tick.
inline std::vector<LevelOutcome> outcomes(const control::Controller& controller) {
  const HierarchyReport& report = controller.record().hierarchy;
  const std::vector<std::string> names = controller.level_names();
  std::vector<LevelOutcome> levels;
  for (std::size_t k = 0; k < static_cast<std::size_t>(report.num_levels); ++k) {
    levels.push_back({.name = names[k],
                      .report = report.levels[k],
                      .active = {},
                      .certificate = {},
                      .verdict = {}});
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(report.num_active); ++i) {
    const ActiveRow& row = report.active[i];
    levels[static_cast<std::size_t>(row.level)].active.emplace_back(
        controller.row_name(row.level, row.id),
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

inline void bind_level(nb::module_& module) {
  using Self = LevelOutcome;
  nb::class_<Self>(module, "Level", "How one level of a hierarchy came out.")
      .def_ro("name", &Self::name)
      .def_prop_ro(
          "residual", [](const Self& self) { return self.report.residual; },
          "√Σ violation² over its rows, in their unit; so far, where the search ended in this "
          "level,\n"
          "and NaN below it")
      .def_ro("active", &Self::active,
              "(row, state) of each inequality row at or beyond a bound; a state is one of\n"
              "at lower, at upper, below lower, above upper")
      .def_ro(
          "certificate", &Self::certificate,
          "how far it is from its optimality conditions, if asked for: at most 1e-8 is rounding")
      .def_ro("verdict", &Self::verdict, "proven, not judged or not proven, if asked for")
      .def_ro("rests_on", &Self::rests_on,
              "index of the first level above that is not proven, so that this one isn't either;\n"
              "None where there is none")
      .def_prop_ro("num_rows", [](const Self& self) { return self.report.num_rows; })
      .def_prop_ro(
          "degrees_of_freedom_left",
          [](const Self& self) { return self.report.degrees_of_freedom_left; },
          "columns of the null space that this level leaves")
      .def_prop_ro(
          "iterations", [](const Self& self) { return self.report.iterations; },
          "of the active-set method")
      .def("__repr__", [](const Self& self) {
        return nb::str("Level({!r}, residual={:.3g}, active={})")
            .format(self.name, self.report.residual, self.active);
      });
}

}  // namespace surefoot::python
