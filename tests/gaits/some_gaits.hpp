#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/signals/per_leg.hpp"

#include <vector>

namespace surefoot::test {

/// Offsets and duties in the order of the legs.
inline gaits::PlannerOptions by_clock(double period, double duty, const PerLeg<double>& offset) {
  gaits::PlannerOptions options;
  options.rhythm.enabled = true;
  options.rhythm.period = period;
  options.rhythm.duty = per_leg(duty);
  options.rhythm.offset = offset;
  options.force.ramp_up = options.force.ramp_down = 0.02;
  options.reflex.enabled = false;
  options.swing.horizontal_start = 0.0;
  options.swing.horizontal_end = 1.0;
  return options;
}

inline gaits::PlannerOptions flying(double period, double duty, const PerLeg<double>& offset) {
  gaits::PlannerOptions options = by_clock(period, duty, offset);
  options.rhythm.flies = true;
  return options;
}

inline const gaits::PlannerOptions kTrot = by_clock(0.5, 0.5, {0.0, 0.5, 0.5, 0.0});
inline const gaits::PlannerOptions kFlight = flying(0.4, 0.4, {0.0, 0.5, 0.5, 0.0});
inline const gaits::PlannerOptions kPace = by_clock(0.4, 0.5, {0.0, 0.5, 0.0, 0.5});
inline const gaits::PlannerOptions kBound = by_clock(0.4, 0.5, {0.0, 0.0, 0.5, 0.5});
inline const gaits::PlannerOptions kPronk = flying(0.5, 0.6, {0.0, 0.0, 0.0, 0.0});

inline gaits::PlannerOptions slow_crawl() {
  gaits::PlannerOptions options = by_clock(1.6, 0.8, {0.25, 0.75, 0.0, 0.5});
  options.rhythm.speed_max = 0.3;
  return options;
}

/// Crawl, trot, flying trot and pace, in this order.
inline std::vector<gaits::NamedGait> some_gaits() {
  gaits::PlannerOptions crawl = slow_crawl(), trot = kTrot, flight = kFlight;
  crawl.rhythm.chosen_to = 0.15;
  trot.rhythm.chosen_to = 1.1;
  flight.rhythm.chosen_to = 2.0;
  return {{"crawl", crawl}, {"trot", trot}, {"flight", flight}, {"pace", kPace}};
}

}  // namespace surefoot::test
