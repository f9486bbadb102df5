#pragma once

#include "surefoot/doctor/diagnosis.hpp"

namespace surefoot::doctor {

// Each check adds what it finds to the diagnosis.

/// Joints of no known type, origins turned in degrees. Others wait until these are mended.
void check_joints(Diagnosis& robot);
/// Masses and inertias of links and bodies: impossible ones, and those in other units.
void check_inertias(Diagnosis& robot);
/// Total mass and leg length: g for kg, mm for m.
void check_size(Diagnosis& robot);
/// Two legs: what can be done with them, and soles that are guesses.
void check_flat_feet(Diagnosis& robot);
/// Feet that differ, are missing or have no sphere.
void check_feet(Diagnosis& robot);
/// Collision shapes in another unit.
void check_shapes(Diagnosis& robot);
/// Knees that turn across their hips, hips that turn across the base, legs that reach up.
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
/// Legs that the stance stretches to their end, feet on the axis of HAA. `check_stance` asks.
void check_singular(Diagnosis& robot);

/// Whether MuJoCo's model of the robot has the same masses, places and dynamics as ours.
void check_agreement(Diagnosis& robot);

}  // namespace surefoot::doctor
