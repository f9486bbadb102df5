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

/// The leg that an event happened to: the plan says what happened, and the legs' phases, before and
/// at the event, tell to which. Empty: to none, or to none that stands out.
[[nodiscard]] std::optional<Leg> leg_of(PlanEvent event, const PerLeg<LegPhase>& before,
                                        const PerLeg<LegPhase>& now);

/// The phases of the legs in a plan.
[[nodiscard]] PerLeg<LegPhase> phases_of(const MotionPlan& plan);

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
