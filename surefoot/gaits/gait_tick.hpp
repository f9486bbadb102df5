#pragma once

#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/hierarchy_outcome.hpp"
#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/signals/robot_state.hpp"
#include "surefoot/signals/user_command.hpp"

namespace surefoot {

/// What gaits and reactions are told at a tick.
struct GaitTick {
  double time = 0.0;        ///< [s]
  double yaw = 0.0;         ///< that the torso is to have [rad]
  const UserCommand& user;  ///< with velocities and a height that the legs can follow
  const RobotState& state;
  const Dynamics& dynamics;
  const HierarchyOutcome& last;  ///< of the tick before
  const MotionPlan& before;      ///< of the tick before
};

}  // namespace surefoot
