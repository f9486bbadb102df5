#pragma once

#include "surefoot/control/stack_options.hpp"
#include "surefoot/model/robot_model.hpp"

#include <limits>
#include <string_view>

namespace surefoot {

/// How far a robot reaches: a bound of a stack that lies beyond it would bound nothing.
struct StackReach {
  double leg = std::numeric_limits<double>::infinity();   ///< longest distance of hip and foot [m]
  double base = std::numeric_limits<double>::infinity();  ///< no foot is further from the base [m]

  /// The greatest value that means something for a task's number; infinity where all do.
  [[nodiscard]] double greatest(std::string_view task, std::string_view number) const;
};

[[nodiscard]] StackReach reach_of(const RobotModel& model);

/// Throws Error on a number beyond the robot's reach; the message says how far that is.
void check_reach(const StackOptions& stack, const StackReach& reach);

}  // namespace surefoot
