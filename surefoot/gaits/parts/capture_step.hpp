#pragma once

#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/support_region.hpp"

namespace surefoot::gaits {

/// A foothold from which the robot can recover its balance.
struct CaptureStep {
  Vec2 goal{0.0, 0.0};   ///< x and y in W [m]
  double margin = -1e3;  ///< of the capture point in the support region after landing [m]
};

/// The situation of a capture step, x and y in W [m].
struct CaptureProblem {
  PerLeg<Vec2> feet;
  Vec2 capture_point{0.0, 0.0};  ///< when the foot lands
  Vec2 hip{0.0, 0.0};            ///< of the leg, when the foot lands
  double reach = 0.0;            ///< of the foot from the hip, horizontally
  double foot_room = 0.12;       ///< least distance between two feet
  double heading = 0.0;          ///< of the torso [rad]: first direction tried
};

/// The shortest candidate step that puts the capture point `capture_margin` inside the support
/// region of all feet; among equally short ones, or if there is none, the one with the greatest
/// margin. Candidates go in all directions, up to `step_max`, within reach, clear of other feet.
[[nodiscard]] CaptureStep find_capture_step(const CaptureProblem& problem, Leg leg,
                                            const PushOptions& options);

}  // namespace surefoot::gaits
