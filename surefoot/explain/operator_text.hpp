#pragma once

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/math/types.hpp"

#include <string>

namespace surefoot::explain {

/// What the operator of a run did, in words: "the operator pushes base with 12 N·s to the left
/// (120 N for 0.1 s)", "friction 0.6 → 0.4, by the operator". Directions are those of the robot's
/// heading; left out where it is not known (NaN).
[[nodiscard]] std::string operator_text(const logged::Change& change, double yaw);

}  // namespace surefoot::explain
