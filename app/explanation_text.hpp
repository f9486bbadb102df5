#pragma once

#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/solver/solution.hpp"

#include <string>

namespace surefoot {

/// Why a hierarchy came out as it did, for people: each level with its residual, the rows at or
/// beyond a bound, and the rows above that hold it back, dearest first.
[[nodiscard]] std::string explanation_text(const NamedHierarchy& question,
                                           const Solution& solution);

}  // namespace surefoot
