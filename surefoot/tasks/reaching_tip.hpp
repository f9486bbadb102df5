#pragma once

#include "surefoot/tasks/task.hpp"

namespace surefoot::tasks {

/// The tip that follows the plan; null: none does.
[[nodiscard]] inline const model::FrameKinematics* reaching_tip(const TaskInput& input) {
  const int arm = input.plan.arm.arm;
  const bool is_there = arm >= 0 && arm < static_cast<int>(input.dynamics.arm_tips.size());
  return is_there ? &input.dynamics.arm_tips[static_cast<std::size_t>(arm)] : nullptr;
}

}  // namespace surefoot::tasks
