#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot {

/// How the legs differ from their description, as far as the robot has found out.
struct LegErrors {
  PerLeg<double> thigh{};                  ///< longer than described by [m]
  PerLeg<double> shank{};                  ///< [m]
  JointVector zero = JointVector::Zero();  ///< what the encoders show at a joint's zero [rad]

  [[nodiscard]] bool operator==(const LegErrors&) const = default;
};

}  // namespace surefoot
