#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/hierarchy_report.hpp"

#include <string_view>
#include <vector>

namespace surefoot::logging {

/// Smallest residual, in its unit, at which a level visibly gave way. NaN: the level wants zero
/// forces or torques, or an arm that reaches at rest, so it always has a residual and never gives
/// way.
[[nodiscard]] double visible_residual(std::string_view level_name, std::string_view unit);

/// The same for the levels of a log.
[[nodiscard]] std::vector<double> visible_residuals(const LogHeader& header);

}  // namespace surefoot::logging
