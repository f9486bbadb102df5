#pragma once

#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/stack_comparison.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace surefoot {

/// What `replay --verify` prints.
[[nodiscard]] std::string verification_text(const std::string& path, const Verification& result);
[[nodiscard]] nlohmann::ordered_json verification_json(const std::string& path,
                                                       const Verification& result);

/// What `replay --stack` prints.
[[nodiscard]] std::string comparison_text(const std::string& path, const StackComparison& result);
[[nodiscard]] nlohmann::ordered_json comparison_json(const std::string& path,
                                                     const StackComparison& result);

}  // namespace surefoot
