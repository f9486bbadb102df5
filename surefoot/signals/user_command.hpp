#pragma once

#include "surefoot/math/numbers.hpp"
#include "surefoot/math/types.hpp"

namespace surefoot {

/// Where the tip of an arm shall be, or a frame that a task of the stack follows.
struct ReachCommand {
  int arm = -1;                             ///< in the robot's order; −1: arms keep their posture
  bool in_world = false;                    ///< position and orientation are in W, else in B
  Vec3 position = Vec3::Zero();             ///< [m]
  Vec3 orientation = Vec3::Constant(kNaN);  ///< roll, pitch, yaw [rad]; NaN: as it was at first
  int frame = -1;  ///< its place in `model::Frames`, from this command on; −1: an arm's tip
};

/// The operator's command. Velocities are in heading axes of the base: horizontal, x along the
/// commanded heading of the torso.
struct UserCommand {
  /// Larger commands are clamped to these.
  static constexpr double kFastest = 3.0;     ///< [m/s] and [rad/s]
  static constexpr double kMostHeight = 0.3;  ///< [m]
  static constexpr int kOwnGait = -1;         ///< that of the planner's options
  static constexpr int kAutoGait = -2;        ///< the speed decides
  static constexpr int kKeepGait = -3;        ///< the present one; of a command with NaN

  bool walk = false;        ///< false: stand on all feet
  Vec2 velocity{0.0, 0.0};  ///< forward (x) and lateral (y) [m/s]
  double yaw_rate = 0.0;    ///< [rad/s]
  double height = 0.0;      ///< offset from the nominal torso height [m]
  /// A change to true: stand, restart the estimate, calibrate on the spot, then continue.
  bool calibrate = false;
  ReachCommand reach{};
  /// Of flat feet that stand: the centre of mass from the middle of the feet [m].
  Vec2 shift{0.0, 0.0};
  int gait = kOwnGait;  ///< in the controller's list of gaits, from 0
};

}  // namespace surefoot
