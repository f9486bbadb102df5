#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/robot_state.hpp"

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

/// What the legs do at a tick.
struct LegsAtTick {
  PerLeg<LegPhase> phases{};
  PerLeg<bool> slips{};  ///< the foot is believed to slide
};

[[nodiscard]] LegsAtTick legs_of(const MotionPlan& plan, const RobotState& state);

/// The leg that an event happened to: the plan says what happened, and what the legs do, before and
/// at the event, tells to which. Empty: to none, or to none that stands out.
[[nodiscard]] std::optional<Leg> leg_of(PlanEvent event, const LegsAtTick& before,
                                        const LegsAtTick& now);

/// Is it worth telling? What every step of a walk has, lift-off and touchdown, is not.
[[nodiscard]] bool is_notable(PlanEvent event);

/// Collects the notable events of a walk, tick by tick.
class EventCounter {
 public:
  void add(double time, const MotionPlan& plan, const RobotState& state);

  /// In the order in which they happened first.
  [[nodiscard]] const std::vector<EventCount>& counts() const { return counts_; }

 private:
  LegsAtTick before_;
  std::vector<EventCount> counts_;
};

}  // namespace surefoot
