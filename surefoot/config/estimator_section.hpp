#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/estimation/leg_inertial_estimator.hpp"

namespace surefoot {

/// The `estimator:` section of a scenario: options of `estimation: sensors`.
void read_estimator(Section& section, LegInertialOptions& options);

}  // namespace surefoot
