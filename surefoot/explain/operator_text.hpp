#pragma once

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/math/types.hpp"

#include <string>

namespace surefoot::explain {

/// What the operator of a run did, in words: "the operator pushes base with 12 N·s to the left
/// (120 N for 0.1 s)", "friction 0.6 → 0.4, by the operator". Directions are relative to the
/// robot's heading `yaw`; left out if it is unknown (NaN).
[[nodiscard]] std::string operator_text(const logged::Change& change, double yaw);

}  // namespace surefoot::explain
