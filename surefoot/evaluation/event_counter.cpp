#include "surefoot/evaluation/event_counter.hpp"

#include <algorithm>
#include <array>

namespace surefoot {
namespace {

/// The plan says what happened, not to which leg: that is the one whose phase tells of it.
std::optional<Leg> leg_of(PlanEvent event, const PerLeg<LegPhase>& before, const MotionPlan& plan) {
  const auto was = [&](Leg leg) { return before[index(leg)]; };
  const auto is = [&](Leg leg) { return plan.feet[index(leg)].phase; };
  const auto find = [](const auto& matches) -> std::optional<Leg> {
    const auto found = std::ranges::find_if(kLegs, matches);
    return found == kLegs.end() ? std::nullopt : std::optional<Leg>(*found);
  };
  if (event == PlanEvent::lost_contact)
    return find([&](Leg leg) { return in_contact(was(leg)) && !in_contact(is(leg)); });
  if (event == PlanEvent::lift_off_aborted)
    return find([&](Leg leg) { return was(leg) == LegPhase::unloading && in_contact(is(leg)); });
  constexpr std::array kOfALegInTheAir{PlanEvent::probe_edge, PlanEvent::late, PlanEvent::no_ground,
                                       PlanEvent::collision, PlanEvent::caught};
  if (std::ranges::find(kOfALegInTheAir, event) == kOfALegInTheAir.end()) return std::nullopt;
  // Of several legs in the air the one that changed its motion.
  const auto changed = [&](Leg leg) { return !in_contact(was(leg)) && was(leg) != is(leg); };
  if (const std::optional<Leg> leg = find(changed)) return leg;
  return find([&](Leg leg) { return !in_contact(is(leg)); });
}

}  // namespace

bool is_notable(PlanEvent event) {
  constexpr std::array kUsual{PlanEvent::none, PlanEvent::lift_off, PlanEvent::touchdown,
                              PlanEvent::probe_same_ground};
  return std::ranges::find(kUsual, event) == kUsual.end();
}

void EventCounter::add(double time, const MotionPlan& plan) {
  const auto event = static_cast<PlanEvent>(plan.event);
  if (is_notable(event)) {
    const std::optional<Leg> leg = leg_of(event, before_, plan);
    auto entry = std::ranges::find_if(
        counts_, [&](const EventCount& known) { return known.event == event && known.leg == leg; });
    if (entry == counts_.end()) {
      entry =
          counts_.insert(counts_.end(), {.event = event, .leg = leg, .count = 0, .first = time});
    }
    ++entry->count;
  }
  for (const Leg leg : kLegs) before_[index(leg)] = plan.feet[index(leg)].phase;
}

}  // namespace surefoot
