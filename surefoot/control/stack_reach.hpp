#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/control/stack_options.hpp"
#include "surefoot/model/robot_model.hpp"

#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace surefoot::control {

/// A length in a stack is beyond the robot's reach.
class BeyondReachError : public Error {
 public:
  BeyondReachError(const std::string& message, std::string task, std::string number)
      : Error(message), task_(std::move(task)), number_(std::move(number)) {}

  [[nodiscard]] const std::string& task() const { return task_; }
  [[nodiscard]] const std::string& number() const { return number_; }

 private:
  std::string task_, number_;
};

/// Reach of a robot's legs: a larger bound in a stack has no effect.
struct StackReach {
  double leg = std::numeric_limits<double>::infinity();   ///< longest distance hip to foot [m]
  double base = std::numeric_limits<double>::infinity();  ///< longest distance base to foot [m]

  /// Largest effective value of a task's number; infinity if there is no limit.
  [[nodiscard]] double greatest(std::string_view task, std::string_view number) const;
};

/// Unlimited for a robot that only stands.
[[nodiscard]] StackReach reach_of(const model::RobotModel& model);

/// Throws BeyondReachError if a number, given or by default, exceeds the robot's reach; the message
/// states the limit.
void check_reach(const StackOptions& stack, const StackReach& reach);

}  // namespace surefoot::control
