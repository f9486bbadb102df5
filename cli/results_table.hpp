#pragma once

#include "surefoot/config/scenario.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace surefoot {

/// A metric's value for people: "0.12 mm", "yes", "–". A metric has
/// one unit, whatever its value.
[[nodiscard]] std::string pretty(const std::string& metric, const nlohmann::ordered_json& value);

/// What the run's criteria ask of a metric, and whether it holds: "≤ 0.5 mm ✓"; empty if nothing.
[[nodiscard]] std::string asked_of(const nlohmann::ordered_json& run, const std::string& metric);

/// One run as a table: metrics with units, what the criteria ask for, the paper's figures, and the
/// notable events.
[[nodiscard]] std::string run_table(const Scenario& scenario, const nlohmann::ordered_json& run);

/// Several seeds: a line for each run that did not succeed, the rates, median and worst of the
/// metrics, and how often the notable events happened.
[[nodiscard]] std::string seeds_table(const Scenario& scenario,
                                      const nlohmann::ordered_json& seeds);

/// Several seeds in a line: how many reached the goal (or succeeded, where there is none), how many
/// fell.
[[nodiscard]] std::string seeds_line(const Scenario& scenario, const nlohmann::ordered_json& seeds);

}  // namespace surefoot
