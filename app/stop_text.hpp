#pragma once

#include "surefoot/signals/tick_record.hpp"

#include <string>

namespace surefoot {

/// Why the controller stopped for safety at this tick: "IMU stopped", "encoder LF_KFE changed
/// too fast", "the torso tilted too far".
[[nodiscard]] std::string text_of_stop(const TickRecord& tick);

}  // namespace surefoot
