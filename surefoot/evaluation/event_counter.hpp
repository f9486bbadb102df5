#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/plan_event.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <optional>
#include <vector>

namespace surefoot {

/// Count of an event of one leg in a run.
struct EventCount {
  PlanEvent event = PlanEvent::none;
  std::optional<Leg> leg;  ///< empty: unknown
  int count = 0;
  double first = 0.0;  ///< time of the first one [s]
};

/// Motion of the legs at a tick.
struct LegsAtTick {
  PerLeg<LegPhase> phases{};
  PerLeg<bool> slips{};  ///< the foot is believed to slide
};

[[nodiscard]] LegsAtTick legs_of(const MotionPlan& plan, const RobotState& state);

/// The leg of an event, found from the legs' motion before and at the event. Empty: none, or
/// ambiguous.
[[nodiscard]] std::optional<Leg> leg_of(PlanEvent event, const LegsAtTick& before,
                                        const LegsAtTick& now);

/// False for lift-off and touchdown, which every step has.
[[nodiscard]] bool is_notable(PlanEvent event);

/// Collects a walk's notable events, tick by tick.
class EventCounter {
 public:
  void add(double time, const MotionPlan& plan, const RobotState& state);

  /// In the order of their first times.
  [[nodiscard]] const std::vector<EventCount>& counts() const { return counts_; }

 private:
  LegsAtTick before_;
  std::vector<EventCount> counts_;
};

}  // namespace surefoot
