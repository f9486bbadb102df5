#pragma once

#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/support_region.hpp"

namespace surefoot::gaits {

/// A foothold that catches the robot.
struct CaptureStep {
  Vec2 goal{0.0, 0.0};   ///< x and y in W [m]
  double margin = -1e3;  ///< of the capture point at the landing in the region with it [m]
};

/// What a step to catch the robot has to reckon with, x and y in W [m].
struct CaptureProblem {
  PerLeg<Vec2> feet;
  Vec2 capture_point{0.0, 0.0};  ///< when the foot lands
  Vec2 hip{0.0, 0.0};            ///< of the leg, when the foot lands
  double reach = 0.0;            ///< of the foot from the hip, horizontally
  double foot_room = 0.12;       ///< between two feet
  double heading = 0.0;          ///< of the torso [rad]: directions are counted from it
};

/// The shortest of some steps in all directions that has the capture point `capture_margin` inside
/// the region of all feet; of equally short ones, and where none has, the one with the most. Steps
/// of up to `step_max` are tried, taken back to where the leg reaches; they keep off the other
/// feet.
[[nodiscard]] CaptureStep find_capture_step(const CaptureProblem& problem, Leg leg,
                                            const PushOptions& options);

}  // namespace surefoot::gaits
