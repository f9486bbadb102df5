#pragma once

#include "surefoot/doctor/finding.hpp"

namespace surefoot::doctor {

/// Puts the elements of an MJCF in place of those of a URDF that the findings name.
void say_as_mjcf(Findings& findings);

}  // namespace surefoot::doctor
