#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/robot_model.hpp"

#include <array>
#include <utility>

namespace surefoot::config {

/// Their names in a scenario.
inline constexpr std::array<std::pair<const char*, gaits::KneeConfiguration>, 3> kKnees{
    {{"x", gaits::KneeConfiguration::x},
     {"forward", gaits::KneeConfiguration::forward},
     {"backward", gaits::KneeConfiguration::backward}}};

/// A knee whose limits let it bend so far to a side is said to bend to it [rad].
inline constexpr double kSideBend = 0.5;

/// Joint angles from which the inverse kinematics of a leg starts: HAA, HFE, KFE [rad], on the side
/// that the configuration asks for, as the robot's nominal posture has its knees in X.
[[nodiscard]] Vec3 knee_side(const model::RobotDescription& robot, Leg leg,
                             gaits::KneeConfiguration knees);

/// The knees that are asked for where the robot's limits allow it, else others that they allow: x,
/// all backward or all forward.
[[nodiscard]] gaits::KneeConfiguration knees_that_fit(const model::RobotDescription& robot,
                                                      gaits::KneeConfiguration wanted);

/// Joint angles of the nominal stance: level torso, feet at ±half_length and ±half_width, the base
/// `height` above the centres of the foot spheres. Throws Error if a leg can't reach, or only with
/// a joint outside the robot's limits.
[[nodiscard]] JointVector stance_posture(const model::RobotModel& model,
                                         const gaits::StanceOptions& stance);

}  // namespace surefoot::config
