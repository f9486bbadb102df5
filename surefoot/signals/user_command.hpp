#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// What the operator asks for. Velocities are those of the base in heading axes: horizontal, x
/// where the torso is to look.
struct UserCommand {
  /// The controller follows no more than these.
  static constexpr double kFastest = 1.0;     ///< [m/s] and [rad/s]
  static constexpr double kMostHeight = 0.3;  ///< [m]

  bool walk = false;        ///< false: stand on four feet
  Vec2 velocity{0.0, 0.0};  ///< forward (x) and lateral (y) [m/s]
  double yaw_rate = 0.0;    ///< [rad/s]
  double height = 0.0;      ///< offset to the nominal torso height [m]
  /// From false to true: stand, begin the estimate anew and calibrate on the spot, then go on.
  bool calibrate = false;
};

}  // namespace surefoot
