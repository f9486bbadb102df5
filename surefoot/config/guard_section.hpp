#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/estimation/reading_guard_options.hpp"

namespace surefoot {

/// Reads `guard:`, what a sensor of the robot can truly give.
void read_guard(Section& section, ReadingGuardOptions& options);

}  // namespace surefoot
