#pragma once

#include "surefoot/replay/stack_comparison.hpp"

#include <cstddef>
#include <string>

namespace surefoot::test {

/// Its largest residual is at 0.5 s, that of its torques at 0.25 s.
inline replay::StackComparison compared() {
  replay::StackComparison result;
  result.ticks = 400;
  result.last_time = 0.9975;
  result.joints.resize(kNumLegJoints);
  for (std::size_t i = 0; i < result.joints.size(); ++i) {
    result.header.robot.joint_names[i] = "joint" + std::to_string(i);
    result.joints[i] = {.rms = 1.0, .largest = -2.0, .time = 0.25};
  }
  result.levels = {{.name = "com_xy",
                    .unit = "m/s²",
                    .in_log = true,
                    .in_other = true,
                    .logged_rms = 0.1,
                    .logged_max = 0.3,
                    .logged_time = 0.5}};
  return result;
}

}  // namespace surefoot::test
