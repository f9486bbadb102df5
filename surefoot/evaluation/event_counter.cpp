#include "surefoot/evaluation/event_counter.hpp"

#include <algorithm>
#include <array>

namespace surefoot {

std::optional<Leg> leg_of(PlanEvent event, const LegsAtTick& before, const LegsAtTick& now) {
  const auto was = [&](Leg leg) { return before.phases[index(leg)]; };
  const auto is = [&](Leg leg) { return now.phases[index(leg)]; };
  const auto find = [](const auto& matches) -> std::optional<Leg> {
    const auto found = std::ranges::find_if(kLegs, matches);
    return found == kLegs.end() ? std::nullopt : std::optional<Leg>(*found);
  };
  const auto changed = [&](Leg leg) { return was(leg) != is(leg); };
  const auto began_to_slide = [&](Leg leg) {
    return now.slips[index(leg)] && !before.slips[index(leg)];
  };
  switch (event) {
    case PlanEvent::lift_off:
    case PlanEvent::touchdown:
    case PlanEvent::push_step:
      return find(changed);
    case PlanEvent::lost_contact:
      return find([&](Leg leg) { return in_contact(was(leg)) && !in_contact(is(leg)); });
    case PlanEvent::slip:
      if (std::ranges::count_if(kLegs, began_to_slide) != 1) return std::nullopt;
      return find(began_to_slide);
    case PlanEvent::lift_off_aborted:
    case PlanEvent::push_reloaded:
      return find([&](Leg leg) { return was(leg) == LegPhase::unloading && in_contact(is(leg)); });
    case PlanEvent::probe_same_ground:
    case PlanEvent::probe_edge:
    case PlanEvent::late:
    case PlanEvent::no_ground:
    case PlanEvent::collision:
    case PlanEvent::push_foot_down:
    case PlanEvent::caught:
      // Of several swing legs the one that changed its motion.
      if (const auto leg = find([&](Leg k) { return !in_contact(was(k)) && changed(k); }))
        return leg;
      return find([&](Leg leg) { return !in_contact(is(leg)); });
    default:
      return std::nullopt;
  }
}

LegsAtTick legs_of(const MotionPlan& plan, const RobotState& state) {
  LegsAtTick legs{.slips = state.slips};
  for (const Leg leg : kLegs) legs.phases[index(leg)] = plan.feet[index(leg)].phase;
  return legs;
}

bool is_notable(PlanEvent event) {
  constexpr std::array kUsual{PlanEvent::none, PlanEvent::lift_off, PlanEvent::touchdown,
                              PlanEvent::probe_same_ground};
  return std::ranges::find(kUsual, event) == kUsual.end();
}

void EventCounter::add(double time, const MotionPlan& plan, const RobotState& state) {
  const LegsAtTick now = legs_of(plan, state);
  const auto event = static_cast<PlanEvent>(plan.event);
  if (is_notable(event)) {
    const std::optional<Leg> leg = leg_of(event, before_, now);
    auto entry = std::ranges::find_if(
        counts_, [&](const EventCount& known) { return known.event == event && known.leg == leg; });
    if (entry == counts_.end()) {
      entry =
          counts_.insert(counts_.end(), {.event = event, .leg = leg, .count = 0, .first = time});
    }
    ++entry->count;
  }
  before_ = now;
}

}  // namespace surefoot
