#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/user_command.hpp"

#include <string>

namespace surefoot::control {

/// Limits the command; values that are not finite become 0, and its gait `kKeepGait`.
[[nodiscard]] UserCommand limited(const UserCommand& user);

/// What is wrong with a plan of the user's own; empty if nothing. Allocates only for what is wrong.
[[nodiscard]] std::string what_is_wrong(const MotionPlan& plan,
                                        const model::RobotDescription& robot);

}  // namespace surefoot::control
