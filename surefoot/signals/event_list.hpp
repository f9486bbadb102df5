#pragma once

#include "surefoot/signals/bounded_list.hpp"
#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace surefoot {

/// Something that happened at a tick.
struct GaitEvent {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  PlanEvent kind = PlanEvent::none;
  std::optional<Leg> leg{};               ///< that it happened to, if to one
  Vec3 place = Vec3::Constant(kUnknown);  ///< of its foot, in W [m]; NaN without a leg
  /// Of the ground on it along the terrain's normal, as estimated; of a push the outside force
  /// along the ground. NaN without [N].
  double force = kUnknown;
};

/// What happened at a tick, in order.
struct EventList : BoundedList<GaitEvent, 8> {
  /// None is not added.
  void add(const GaitEvent& event) {
    if (event.kind != PlanEvent::none) BoundedList::add(event);
  }
  void add(const EventList& events) {
    for (const GaitEvent& event : events) add(event);
  }
  [[nodiscard]] bool has(PlanEvent kind) const {
    return std::ranges::find(*this, kind, &GaitEvent::kind) != end();
  }
};

}  // namespace surefoot
