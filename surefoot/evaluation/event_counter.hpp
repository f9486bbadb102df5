#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <optional>
#include <vector>

namespace surefoot {

/// How often something happened to a leg in a run.
struct EventCount {
  PlanEvent event = PlanEvent::none;
  std::optional<Leg> leg;  ///< empty: none stands out
  int count = 0;
  double first = 0.0;  ///< when it happened first [s]
};

/// Is it worth telling? What every step of a walk has, lift-off and touchdown, is not.
[[nodiscard]] bool is_notable(PlanEvent event);

/// Collects the notable events of a walk, plan by plan.
class EventCounter {
 public:
  void add(double time, const MotionPlan& plan);

  /// In the order in which they happened first.
  [[nodiscard]] const std::vector<EventCount>& counts() const { return counts_; }

 private:
  PerLeg<LegPhase> before_{};
  std::vector<EventCount> counts_;
};

}  // namespace surefoot
