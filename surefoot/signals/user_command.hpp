#pragma once

#include "surefoot/math/types.hpp"

namespace surefoot {

/// The operator's command. Velocities are in heading axes of the base: horizontal, x along the
/// commanded heading of the torso.
struct UserCommand {
  /// Larger commands are clamped to these.
  static constexpr double kFastest = 1.0;     ///< [m/s] and [rad/s]
  static constexpr double kMostHeight = 0.3;  ///< [m]

  bool walk = false;        ///< false: stand on four feet
  Vec2 velocity{0.0, 0.0};  ///< forward (x) and lateral (y) [m/s]
  double yaw_rate = 0.0;    ///< [rad/s]
  double height = 0.0;      ///< offset from the nominal torso height [m]
  /// A change to true: stand, restart the estimate, calibrate on the spot, then continue.
  bool calibrate = false;
};

}  // namespace surefoot
