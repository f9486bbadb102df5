#pragma once

#include "surefoot/control/controller.hpp"

#include <string>
#include <vector>

namespace surefoot::control {

[[nodiscard]] bool has_own_gait(const ControllerOptions& options);
/// The user's own gaits, "gait sway", and those own tasks that the stack names, "task lean".
[[nodiscard]] std::vector<std::string> own_gaits_and_tasks(const ControllerOptions& options);

}  // namespace surefoot::control
