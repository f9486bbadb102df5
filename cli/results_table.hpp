#pragma once

#include "surefoot/config/scenario.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace surefoot::cli {

/// A metric's value for people: "0.12 mm", "yes", "–".
[[nodiscard]] std::string pretty(const std::string& metric, const nlohmann::ordered_json& value);

/// One run as a table: metrics with units, criteria, the paper's figures, and notable events. The
/// ten metrics that matter and those that are compared with something; or `all`.
[[nodiscard]] std::string run_table(const config::Scenario& scenario,
                                    const nlohmann::ordered_json& run, bool all = false);

}  // namespace surefoot::cli
