#pragma once

#include "surefoot/signals/event_list.hpp"

#include <vector>

namespace surefoot::test {

/// What happened, in order.
inline std::vector<PlanEvent> kinds_of(const EventList& events) {
  std::vector<PlanEvent> kinds;
  for (const GaitEvent& event : events) kinds.push_back(event.kind);
  return kinds;
}

}  // namespace surefoot::test
