#pragma once

#include "surefoot/gaits/planner_options.hpp"
#include "surefoot/model/robot_model.hpp"

#include <array>
#include <utility>

namespace surefoot::config {

/// Names of the knee configurations in a scenario.
inline constexpr std::array<std::pair<const char*, gaits::KneeConfiguration>, 3> kKnees{
    {{"x", gaits::KneeConfiguration::x},
     {"forward", gaits::KneeConfiguration::forward},
     {"backward", gaits::KneeConfiguration::backward}}};

/// A knee whose limits let it bend so far to a side can bend to it [rad].
inline constexpr double kSideBend = 0.5;

/// Start of a leg's inverse kinematics: HAA, HFE, KFE [rad], with the knee on the side of the
/// configuration. The robot's nominal posture is an X-configuration.
[[nodiscard]] Vec3 knee_side(const model::RobotDescription& robot, Leg leg,
                             gaits::KneeConfiguration knees);

/// Do the limits let a leg's knee bend to the side of this angle's sign?
[[nodiscard]] bool can_bend(const model::RobotDescription& robot, Leg leg, double knee);

/// The wanted configuration if the joint limits allow it, else x, backward or forward.
[[nodiscard]] gaits::KneeConfiguration knees_that_fit(const model::RobotDescription& robot,
                                                      gaits::KneeConfiguration wanted);

/// Joint angles of the nominal stance: level torso, feet at ±half_length and ±half_width, the base
/// `height` above the centres of the foot spheres. Throws Error if a leg can't reach, or only with
/// a joint outside the robot's limits. The nominal posture of a robot that only stands.
[[nodiscard]] JointVector stance_posture(const model::RobotModel& model,
                                         const gaits::StanceOptions& stance);

}  // namespace surefoot::config
