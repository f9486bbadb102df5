#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/signals/hierarchy_report.hpp"

#include <string_view>
#include <vector>

namespace surefoot {

/// From this residual on a level gave way, in its unit: what is less is nothing that people should
/// see. NaN: the level asks for no force or torque at all, is never content, and gives way to none.
[[nodiscard]] double visible_residual(std::string_view level_name, std::string_view unit);

/// The same for the levels of a log.
[[nodiscard]] std::vector<double> visible_residuals(const LogHeader& header);

}  // namespace surefoot
