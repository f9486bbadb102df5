#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/estimation/reading_guard_options.hpp"
#include "surefoot/estimation/sensor_consistency_options.hpp"

namespace surefoot {

/// Reads `guard:`, what a sensor of the robot can truly give, and how far sensors may contradict
/// each other.
void read_guard(Section& section, ReadingGuardOptions& options,
                SensorConsistencyOptions& consistency);

}  // namespace surefoot
