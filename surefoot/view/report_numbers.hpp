#pragma once

#include "surefoot/view/outcome.hpp"

#include <string>

namespace surefoot::report {

/// The run's numbers as a table: first each one that a criterion limits or the paper has a figure
/// of, side by side, then what else matters; below, all metrics under their names.
[[nodiscard]] std::string numbers(const Outcome& outcome);

/// What people call a metric, e.g. "goal reached".
[[nodiscard]] std::string name_of(const std::string& metric);

}  // namespace surefoot::report
