#pragma once

#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/stack_comparison.hpp"

#include <string>

namespace surefoot::replay {

/// A result for programs, as JSON in SI units. `path`: of the log.
[[nodiscard]] std::string json_of(const std::string& path, const Verification& result);
[[nodiscard]] std::string json_of(const std::string& path, const StackComparison& result);

}  // namespace surefoot::replay
