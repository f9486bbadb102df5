#pragma once

#include "surefoot/doctor/diagnosis.hpp"

namespace surefoot::doctor {

// Each check adds what it finds to the diagnosis.

/// Masses and inertias of links and bodies: impossible ones, and those in other units.
void check_inertias(Diagnosis& robot);
/// Total mass and leg length: g for kg, mm for m.
void check_size(Diagnosis& robot);
/// Two legs: what can be done with them, and soles that are guesses.
void check_flat_feet(Diagnosis& robot);
/// Feet that differ, are missing or have no sphere.
void check_feet(Diagnosis& robot);
/// Knees that turn across their hips.
void check_axes(Diagnosis& robot);
/// Effort, velocity and position limits: missing, placeholders, too weak to stand.
void check_limits(Diagnosis& robot);
/// Left against right, front against hind.
void check_symmetry(Diagnosis& robot);
/// Joints that turn the other way than those of the other legs, and knees that bend one way only.
void check_signs(Diagnosis& robot);
/// Joints whose names say another leg than the one at whose place they are.
void check_names(Diagnosis& robot);
/// The start of a walk as the program checks it: stance, overlaps, shapes below the feet. Also
/// which knees are chosen where the limits don't leave those that a scenario asks for.
void check_stance(Diagnosis& robot);

/// Whether MuJoCo's model of the robot has the same masses, places and dynamics as ours.
void check_agreement(Diagnosis& robot);

/// Which limits of a joint, or of any, have to be filled in.
struct LimitGaps {
  bool effort = false, velocity = false, position = false;  ///< a placeholder, or missing
};

/// Without the standing torque an effort counts as a placeholder from 1000 N·m on.
[[nodiscard]] LimitGaps gaps_of(const Diagnosis& robot, const model::UrdfJoint& joint);
/// Does any joint of the legs lack a limit? Of two legs with flat feet: false.
[[nodiscard]] bool has_gaps(const Diagnosis& robot);

}  // namespace surefoot::doctor
