#pragma once

#include "surefoot/control/controller.hpp"
#include "surefoot/model/description.hpp"

#include <optional>
#include <string>
#include <vector>

namespace surefoot::closed_loop {

/// A run's reason with what a part of the user's own did wrong, if anything.
[[nodiscard]] std::string with_fault(const std::string& reason, const std::string& fault);

/// When a controller stopped for safety, and why.
class StopWatch {
 public:
  explicit StopWatch(const model::RobotDescription& robot);

  /// At every tick.
  void update(const control::Controller& controller, double time);

  [[nodiscard]] bool has_stopped() const;
  /// The stop first, as it decides the exit code; then a later `fall`, if that is not empty.
  [[nodiscard]] std::string reason(const std::string& fall) const;

 private:
  std::vector<std::string> joints_;
  std::optional<double> time_;  // of the stop [s]
  std::string why_;
};

}  // namespace surefoot::closed_loop
