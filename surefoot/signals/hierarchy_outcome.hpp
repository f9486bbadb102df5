#pragma once

#include "surefoot/signals/leg.hpp"
#include "surefoot/signals/sensor_reading.hpp"

namespace surefoot {

/// The planner's view of the hierarchy's last tick.
struct HierarchyOutcome {
  /// Unmet share of the torso's roll and pitch acceleration [rad/s²]; NaN: not known.
  double tilt_shortfall = kNaN;
  /// Unit normal in W of the friction pyramid that bounds each foot's force; NaN: none.
  PerLeg<Vec3> pyramid_normal = per_leg<Vec3>(Vec3::Constant(kNaN));
};

}  // namespace surefoot
