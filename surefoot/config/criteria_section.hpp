#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/evaluation/criteria.hpp"

#include <vector>

namespace surefoot::config {

/// Reads limits on metrics, under the metrics' names:
///
///     com_error_max_m: {max: 0.0005}
///
/// The defaults are `fell: false` and, for a scenario with a goal, `goal_reached: true`.
void read_criteria(Section& section, bool has_goal, std::vector<evaluation::Criterion>& criteria);

/// The metrics that criteria and the paper's figures can name.
[[nodiscard]] std::vector<std::string> metric_names();

}  // namespace surefoot::config
