#pragma once

#include "surefoot/config/scenario.hpp"
#include "surefoot/simulation/ground_truth.hpp"

namespace surefoot {

/// Says when a run has reached its scenario's goal, on the simulator's truth.
class GoalWatch {
 public:
  explicit GoalWatch(const Goal& goal) : goal_(goal) {}

  /// One tick. True from the one on at which the goal is reached; without a goal never.
  bool update(const GroundTruth& truth);

  [[nodiscard]] bool has_goal() const;
  /// True also without a goal.
  [[nodiscard]] bool reached() const { return reached_ || !has_goal(); }

 private:
  [[nodiscard]] bool all_feet_beyond(const GroundTruth& truth) const;

  Goal goal_;
  double passed_at_x_ =
      std::numeric_limits<double>::quiet_NaN();  // base, when all feet were beyond [m]
  bool reached_ = false;
};

}  // namespace surefoot
