#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/simulation/ground_truth.hpp"

#include <optional>

namespace surefoot::closed_loop {

/// Finds out when a run has reached its scenario's goal, by the simulator's truth.
class GoalWatch {
 public:
  explicit GoalWatch(const config::Goal& goal) : goal_(goal) {}

  /// One tick. True from the tick on that reaches the goal; without a goal never.
  bool update(const simulation::GroundTruth& truth);

  /// Empty without a goal.
  [[nodiscard]] std::optional<bool> reached() const;

 private:
  [[nodiscard]] bool has_goal() const;
  [[nodiscard]] bool all_feet_beyond(const simulation::GroundTruth& truth) const;

  config::Goal goal_;
  double passed_at_x_ = kNaN;  // of the base, when all feet had passed the goal [m]
  bool reached_ = false;
};

}  // namespace surefoot::closed_loop
