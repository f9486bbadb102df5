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
  std::filesystem::path video;   ///< film; empty: none; needs a log
  bool pictures = true;          ///< in the report
};

/// Did the run come to its end? Not so a row of one that was cut off by an interrupt, or that never
/// began.
[[nodiscard]] bool is_whole(const nlohmann::ordered_json& row);

/// Runs them, `jobs` at a time. The result has a row (run_json, or crash_json) for each, in their
/// order. After an interrupt some are not whole.
[[nodiscard]] std::vector<nlohmann::ordered_json> run_all(
    const std::vector<PlannedRun>& runs, int jobs,
    const std::function<void(std::size_t run, const nlohmann::ordered_json& row)>& finished);

}  // namespace surefoot
