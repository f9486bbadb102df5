#pragma once

#include "surefoot/config/scenario_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

namespace surefoot {

/// One run in a process of its own.
struct PlannedRun {
  ScenarioRequest request;
  std::filesystem::path log;     ///< empty: none
  std::filesystem::path report;  ///< folder; empty: none; needs a log
};

/// Runs them, `jobs` at a time. The result has a row (run_json, or crash_json) for each, in their
/// order. After an interrupt the rows mean nothing.
[[nodiscard]] std::vector<nlohmann::ordered_json> run_all(
    const std::vector<PlannedRun>& runs, int jobs,
    const std::function<void(std::size_t run, const nlohmann::ordered_json& row)>& finished);

}  // namespace surefoot
