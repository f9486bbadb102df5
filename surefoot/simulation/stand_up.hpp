#pragma once

#include "surefoot/simulation/robot_parts.hpp"

namespace surefoot::simulation {

struct StandUpOptions {
  JointVector q = JointVector::Zero();             ///< the posture [rad]
  JointVector torque_limit = JointVector::Zero();  ///< [N·m]
  double at_least = 0.0;                           ///< how long it lasts [s]
  double timestep = 0.0005;                        ///< of the physics [s]
  bool limp = false;                               ///< its joints only damp
};

/// Stands the robot up before a run, as somebody does who sets it down: springs hold its joints,
/// a foot that stays in the air is let down until it stands. One whose joints are limp sinks down;
/// and when nothing moves any more, or after 5 s, the run may begin. `data` must be as after
/// mj_step1, and is so afterwards; its time is then 0. Returns the torques that hold the robot
/// [N·m].
JointVector stand_up(const mjModel& model, mjData& data, const RobotParts& parts,
                     const StandUpOptions& options);

}  // namespace surefoot::simulation
