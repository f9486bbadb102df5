#pragma once

#include "surefoot/evaluation/start_alignment.hpp"
#include "surefoot/logging/message_fields.hpp"

/// The estimate's fields in the viewer and in `explain`.
namespace surefoot::logged {

template <typename Archive, Is<evaluation::AlignedEstimate> T>
void fields(Archive& field, T& estimate) {
  field("p_SB", estimate.p_SB,
        "believed base position, counted from the true one at the first tick, in S [m]");
  field("q_SB", estimate.q_SB,
        "believed base orientation as quaternion w, x, y, z, with the true heading of the first "
        "tick; takes B coordinates to S");
  field("position_error", estimate.position_error,
        "of the believed base position since the first tick [m]");
  field("heading_error", estimate.heading_error,
        "of the believed heading since the first tick, to the left [rad]");
}

}  // namespace surefoot::logged
