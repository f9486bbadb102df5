#pragma once

#include "surefoot/model/robot_model.hpp"
#include "surefoot/planning/planner_options.hpp"

namespace surefoot {

/// Joint angles on a knee side from which the inverse kinematics of a leg starts: HAA, HFE, KFE
/// [rad].
[[nodiscard]] Vec3 knee_side(Leg leg, KneeConfiguration knees);

/// Joint angles of the nominal stance: level torso, feet at ±half_length and ±half_width, the base
/// `height` above the centres of the foot spheres. Throws Error if a leg can't reach.
[[nodiscard]] JointVector stance_posture(const RobotModel& model, const StanceOptions& stance);

}  // namespace surefoot
