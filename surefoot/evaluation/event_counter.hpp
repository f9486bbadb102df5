#pragma once

#include "surefoot/signals/event_list.hpp"

#include <optional>
#include <vector>

namespace surefoot::evaluation {

/// Count of an event of one leg in a run.
struct EventCount {
  PlanEvent event = PlanEvent::none;
  std::optional<Leg> leg;  ///< empty: not of one leg
  int count = 0;
  double first = 0.0;  ///< time of the first one [s]
};

/// False for lift-off and touchdown, which every step has.
[[nodiscard]] bool is_notable(PlanEvent event);

/// Collects a walk's notable events, tick by tick.
class EventCounter {
 public:
  void add(double time, const EventList& events);

  /// In the order of their first times.
  [[nodiscard]] const std::vector<EventCount>& counts() const { return counts_; }

 private:
  std::vector<EventCount> counts_;
};

}  // namespace surefoot::evaluation
