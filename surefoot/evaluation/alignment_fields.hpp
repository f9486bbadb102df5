#pragma once

#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/logging/message_fields.hpp"

/// The fields of /alignment, for the log and for Python.
namespace surefoot::logged {

template <typename Archive, Is<evaluation::WorldPose> T>
void fields(Archive& field, T& pose) {
  field("p_WS", pose.p_WS, "origin of S in W [m]");
  field("q_WS", pose.q_WS, "orientation as quaternion w, x, y, z; takes S coordinates to W");
}

template <typename Archive, Is<evaluation::Alignment> T>
void fields(Archive& field, T& alignment) {
  field("time", alignment.time, "of the simulation [s]");
  field("feet", alignment.feet, "by the feet that stand: for plans");
  field("start", alignment.start, "as at the first tick: for the estimate");
  field("com_error", alignment.com_error, "true centre of mass minus the planned one, in W [m]");
  field("height_error", alignment.height_error,
        "true height of the base minus the planned one, by the feet [m]");
  field("base_error", alignment.base_error,
        "believed base minus the true one, since the start, in W [m]");
  field("heading_error", alignment.heading_error,
        "believed heading minus the true one, since the start, to the left [rad]");
}

}  // namespace surefoot::logged
