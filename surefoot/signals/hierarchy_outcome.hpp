#pragma once

#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// What the planner is told of the hierarchy's last tick.
struct HierarchyOutcome {
  /// Left undone of the torso's roll and pitch [rad/s²]; NaN: not known.
  double tilt_shortfall = kNaN;
  /// Unit, in W: of the friction pyramid that the force of each foot was asked to stay in, had it
  /// one; NaN: there is none.
  PerLeg<Vec3> pyramid_normal{Vec3::Constant(kNaN), Vec3::Constant(kNaN), Vec3::Constant(kNaN),
                              Vec3::Constant(kNaN)};
};

}  // namespace surefoot
