#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/user_command.hpp"

#include <string_view>

namespace surefoot::control {

/// Limits the command; values that are not finite become 0.
[[nodiscard]] UserCommand limited(const UserCommand& user);

/// What is wrong with a plan of the user's own; empty if nothing.
[[nodiscard]] std::string_view what_is_wrong(const MotionPlan& plan,
                                             const model::RobotDescription& robot);

}  // namespace surefoot::control
