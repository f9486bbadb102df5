#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/gaits/planner_options.hpp"

namespace surefoot {

/// Reads every field of PlannerOptions under its own name.
void read_planner(Section& section, PlannerOptions& options);

}  // namespace surefoot
