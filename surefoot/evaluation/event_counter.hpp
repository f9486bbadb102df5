#pragma once

#include "surefoot/signals/event_list.hpp"

#include <optional>
#include <vector>

namespace surefoot {

/// How often something happened to a leg in a run.
struct EventCount {
  PlanEvent event = PlanEvent::none;
  std::optional<Leg> leg;  ///< empty: of none, or not of one
  int count = 0;
  double first = 0.0;  ///< when it happened first [s]
};

/// Is it worth telling? What every step of a walk has, lift-off and touchdown, is not.
[[nodiscard]] bool is_notable(PlanEvent event);

/// Collects the notable events of a walk, tick by tick.
class EventCounter {
 public:
  void add(double time, const EventList& events);

  /// In the order in which they happened first.
  [[nodiscard]] const std::vector<EventCount>& counts() const { return counts_; }

 private:
  std::vector<EventCount> counts_;
};

}  // namespace surefoot
