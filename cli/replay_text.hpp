#pragma once

#include "surefoot/replay/log_verification.hpp"
#include "surefoot/replay/stack_comparison.hpp"

#include <string>

namespace surefoot::cli {

/// What `replay --verify` prints.
[[nodiscard]] std::string verification_text(const std::string& path,
                                            const replay::Verification& result);

/// What `replay --stack` prints.
[[nodiscard]] std::string comparison_text(const std::string& path,
                                          const replay::StackComparison& result);

}  // namespace surefoot::cli
