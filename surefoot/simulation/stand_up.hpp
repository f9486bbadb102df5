#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/simulation/robot_parts.hpp"

namespace surefoot::simulation {

struct StandUpOptions {
  JointVector q;             ///< the posture [rad]
  JointVector torque_limit;  ///< [N·m]
  double at_least = 0.0;     ///< shortest duration [s]
  double timestep = 0.0005;  ///< of the physics [s]
  bool limp = false;         ///< the joints only damp
  Scale scale{};             ///< of the robot
};

/// Stands the robot up before a run: springs hold its joints, and a foot in the air is lowered
/// until it stands. A limp robot sinks down. Ends when nothing moves any more, or after 5 s (of the
/// reference robot). `data` must be as after mj_step1, and is so afterwards, with time 0. Returns
/// the torques that hold the robot [N·m].
JointVector stand_up(const mjModel& model, mjData& data, const RobotParts& parts,
                     const StandUpOptions& options);

}  // namespace surefoot::simulation
