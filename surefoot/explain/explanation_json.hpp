#pragma once

#include "surefoot/explain/level_account.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/solution.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace surefoot {

/// What `explanation_text` says, whole, for programs. Levels are counted from 1, as in messages;
/// costs and residuals are in the level's unit, times in seconds. `certificates` may be empty,
/// and end where the search was cut off.
[[nodiscard]] nlohmann::ordered_json explanation_json(
    const std::vector<LevelAccount>& levels, const Solution& solution,
    const std::vector<LevelCertificate>& certificates);

}  // namespace surefoot
