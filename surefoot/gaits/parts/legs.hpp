#pragma once

#include "surefoot/gaits/parts/leg_motion.hpp"

#include <algorithm>

namespace surefoot {

/// The motion of all legs.
class Legs {
 public:
  /// `period` of the control loop [s].
  Legs(const PlannerOptions& options, double period)
      : legs_{motion(options, period), motion(options, period), motion(options, period),
              motion(options, period)} {}

  [[nodiscard]] LegMotion& operator[](Leg leg) { return legs_[index(leg)]; }
  [[nodiscard]] const LegMotion& operator[](Leg leg) const { return legs_[index(leg)]; }

  [[nodiscard]] PerLeg<bool> down() const {
    PerLeg<bool> result{};
    for (const Leg k : kLegs) result[index(k)] = (*this)[k].down();
    return result;
  }
  [[nodiscard]] bool all_down() const {
    return std::ranges::all_of(legs_, [](const LegMotion& leg) { return leg.down(); });
  }
  [[nodiscard]] PerLeg<Vec3> footholds() const {
    PerLeg<Vec3> result;
    for (const Leg k : kLegs) result[index(k)] = (*this)[k].foothold();
    return result;
  }

 private:
  static LegMotion motion(const PlannerOptions& options, double period) {
    return {options.swing, options.contact, options.force, period, options.reflex};
  }

  PerLeg<LegMotion> legs_;
};

}  // namespace surefoot
