#pragma once

#include "surefoot/explain/level_account.hpp"
#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/solution.hpp"

#include <string>
#include <vector>

namespace surefoot {

/// Why a hierarchy came out as it did, for people: status, iterations and time, then each level
/// with its residual, the rows that it missed or holds at a bound, and the rows above that hold it
/// back, dearest first. `certificates` may be empty,
/// and end where the search was cut off; `is_budget_spent`: that is why.
[[nodiscard]] std::string explanation_text(const std::vector<LevelAccount>& levels,
                                           const Solution& solution,
                                           const std::vector<LevelCertificate>& certificates,
                                           bool is_budget_spent);

}  // namespace surefoot
