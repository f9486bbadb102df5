#pragma once

#include "surefoot/config/section.hpp"
#include "surefoot/control/controller.hpp"

namespace surefoot {

/// Reads what a scenario says of the controller, stack and level switches aside.
void read_controller(Section& top, ControllerOptions& controller);

}  // namespace surefoot
