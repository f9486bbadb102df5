#pragma once

#include "surefoot/simulation/ground_truth.hpp"
#include "surefoot/simulation/robot_parts.hpp"

namespace surefoot::simulation {

/// The truth at the state of `data`, whose positions, velocities and accelerations must be current.
/// Does not allocate after the first call.
void extract_truth(const mjModel& model, mjData& data, const RobotParts& parts,
                   GroundTruth& truth) noexcept;

/// Marks the feet with ground force in the last physics step; `data.contact` must still be of that
/// step.
void note_touches(const mjModel& model, const mjData& data, const RobotParts& parts,
                  PerLeg<bool>& touched) noexcept;

/// Joint positions and velocities in our order.
[[nodiscard]] JointVector joint_positions(const mjData& data, const RobotParts& parts) noexcept;
[[nodiscard]] JointVector joint_velocities(const mjData& data, const RobotParts& parts) noexcept;

/// Base orientation and velocity.
[[nodiscard]] Quat base_orientation(const mjData& data, const RobotParts& parts) noexcept;
[[nodiscard]] Vec3 base_velocity(const mjData& data, const RobotParts& parts) noexcept;

}  // namespace surefoot::simulation
