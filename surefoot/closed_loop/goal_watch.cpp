#include "surefoot/closed_loop/goal_watch.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::closed_loop {

std::optional<bool> GoalWatch::reached() const {
  return has_goal() ? std::optional<bool>(reached_) : std::nullopt;
}

bool GoalWatch::has_goal() const { return std::isfinite(goal_.feet_beyond_x); }

bool GoalWatch::all_feet_beyond(const simulation::GroundTruth& truth) const {
  return std::ranges::all_of(truth.feet.legs(), [&](Leg leg) {
    return truth.feet[index(leg)].touching && truth.p_SF[index(leg)].x() > goal_.feet_beyond_x;
  });
}

bool GoalWatch::update(const simulation::GroundTruth& truth) {
  if (!has_goal() || reached_) return reached_;
  if (std::isnan(passed_at_x_) && all_feet_beyond(truth)) passed_at_x_ = truth.p_SB.x();
  reached_ = truth.p_SB.x() - passed_at_x_ >= goal_.walk_on;  // false while it is NaN
  return reached_;
}

}  // namespace surefoot::closed_loop
