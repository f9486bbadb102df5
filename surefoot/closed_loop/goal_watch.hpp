#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <limits>
#include <optional>

namespace surefoot::closed_loop {

/// Says when a run has reached its scenario's goal, on the simulator's truth.
class GoalWatch {
 public:
  explicit GoalWatch(const config::Goal& goal) : goal_(goal) {}

  /// One tick. True from the one on at which the goal is reached; without a goal never.
  bool update(const simulation::GroundTruth& truth);

  /// Empty without a goal.
  [[nodiscard]] std::optional<bool> reached() const;

 private:
  [[nodiscard]] bool has_goal() const;
  [[nodiscard]] bool all_feet_beyond(const simulation::GroundTruth& truth) const;

  config::Goal goal_;
  double passed_at_x_ =
      std::numeric_limits<double>::quiet_NaN();  // base, when all feet were beyond [m]
  bool reached_ = false;
};

}  // namespace surefoot::closed_loop
