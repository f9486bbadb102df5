#pragma once

#include "surefoot/closed_loop/closed_loop.hpp"

#include <nlohmann/json.hpp>

namespace surefoot::cli {

/// One run: every metric under its name, and beside them `scenario`, `stack`, `estimation`,
/// `criteria`, `events` (each with leg, count and first time), `drawn`, `notes` and `torques_hash`,
/// which is that of every run with the same torques; of a run that was watched live
/// `changes_by_hand`, how many there were.
[[nodiscard]] nlohmann::ordered_json run_json(const config::Scenario& scenario,
                                              const closed_loop::RunResult& result);

/// What a run of the scenario would be made from: scenario, version and commit of the program,
/// `sources_hash`; what it is judged by: `has_goal`, `success_rate`, the `paper`'s figures; and the
/// `metrics` that it would measure, each with which end of it is the worst and whether the
/// machine's clock decides it.
[[nodiscard]] nlohmann::ordered_json check_json(const config::Scenario& scenario);

}  // namespace surefoot::cli
