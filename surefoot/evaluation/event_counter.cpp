#include "surefoot/evaluation/event_counter.hpp"

#include <algorithm>
#include <array>

namespace surefoot::evaluation {

bool is_notable(PlanEvent event) {
  constexpr std::array kUsual{PlanEvent::none, PlanEvent::lift_off, PlanEvent::touchdown,
                              PlanEvent::probe_same_ground};
  return std::ranges::find(kUsual, event) == kUsual.end();
}

void EventCounter::add(double time, const EventList& events) {
  for (const GaitEvent& event : events) {
    if (!is_notable(event.kind)) continue;
    auto entry = std::ranges::find_if(counts_, [&](const EventCount& known) {
      return known.event == event.kind && known.leg == event.leg;
    });
    if (entry == counts_.end()) {
      counts_.push_back({.event = event.kind, .leg = event.leg, .count = 0, .first = time});
      entry = counts_.end() - 1;
    }
    ++entry->count;
  }
}

}  // namespace surefoot::evaluation
