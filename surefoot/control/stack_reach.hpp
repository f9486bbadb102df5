#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/model/robot_model.hpp"

#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace surefoot::control {

/// A number of a stack lies beyond the robot's reach.
class BeyondReachError : public Error {
 public:
  BeyondReachError(const std::string& message, std::string task, std::string number)
      : Error(message), task_(std::move(task)), number_(std::move(number)) {}

  [[nodiscard]] const std::string& task() const { return task_; }
  [[nodiscard]] const std::string& number() const { return number_; }

 private:
  std::string task_, number_;
};

/// How far a robot reaches: a bound of a stack that lies beyond it would bound nothing.
struct StackReach {
  double leg = std::numeric_limits<double>::infinity();   ///< longest distance of hip and foot [m]
  double base = std::numeric_limits<double>::infinity();  ///< no foot is further from the base [m]

  /// The greatest value that means something for a task's number; infinity where all do.
  [[nodiscard]] double greatest(std::string_view task, std::string_view number) const;
};

[[nodiscard]] StackReach reach_of(const model::RobotModel& model);

/// Throws BeyondReachError on a number beyond the robot's reach, given or by default; the message
/// says how far that is.
void check_reach(const StackOptions& stack, const StackReach& reach);

}  // namespace surefoot::control
