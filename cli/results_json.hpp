#pragma once

#include "cli/process_pool.hpp"
#include "surefoot/closed_loop/closed_loop.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <vector>

namespace surefoot {

/// One run: every metric under its name, and beside them `scenario`, `stack`, `estimation`,
/// `criteria`, `events` (each with leg, count and first time), `drawn`, `notes` and `torques_hash`,
/// which is that of every run with the same torques; of a run that was watched live
/// `changes_by_hand`, how many there were.
[[nodiscard]] nlohmann::ordered_json run_json(const Scenario& scenario, const RunResult& result);

/// What a run of the scenario would be made from: scenario, version and commit of the program,
/// `sources_hash`, and the `metrics` that it would measure, each with which end of it is the worst
/// and whether the machine's clock decides it.
[[nodiscard]] nlohmann::ordered_json check_json(const Scenario& scenario);

/// The row of a run that gave no result: `seed`, `crashed` and the reason.
[[nodiscard]] nlohmann::ordered_json crash_json(std::uint64_t seed, const std::string& reason);

/// Several seeds: `runs`; `rates`, each with successes, trials and Wilson's 95 % `interval`;
/// `metrics`, each with its median and the worst of all runs; `events`, in how many runs and how
/// often in all; `version`.
[[nodiscard]] nlohmann::ordered_json seeds_json(const Scenario& scenario,
                                                std::vector<nlohmann::ordered_json> runs);

/// Did chance have no part in the seeds? Then a rate over them says nothing.
[[nodiscard]] bool all_the_same(const std::vector<nlohmann::ordered_json>& runs);

/// Did as large a share of the runs succeed as the scenario asks for?
[[nodiscard]] bool enough_succeeded(const Scenario& scenario,
                                    const std::vector<nlohmann::ordered_json>& runs);

}  // namespace surefoot
