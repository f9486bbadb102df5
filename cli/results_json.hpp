#pragma once

#include "surefoot/closed_loop/closed_loop.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::cli {

/// One run: every metric by its name; also `scenario`, `stack`, `estimation`, `criteria`, `events`
/// (each with leg, count and first time), `drawn`, `notes` and `torques_hash` (equal for runs with
/// the same torques). `succeeded` and a criterion's
/// `passed` are null where they were not judged: the run is shorter than `judged_after_s`. A run
/// that was watched live also has the number of `changes_by_hand`.
[[nodiscard]] nlohmann::ordered_json run_json(const config::Scenario& scenario,
                                              const closed_loop::RunResult& result);

/// Inputs of a run: scenario, version and commit of the program, `sources_hash`. Its judgement:
/// `has_goal`, `success_rate`, the `paper`'s figures. Its `metrics`, as in
/// numbers_json().
[[nodiscard]] nlohmann::ordered_json check_json(const config::Scenario& scenario);

}  // namespace surefoot::cli
