#pragma once

#include "surefoot/signals/tick_context.hpp"
#include "tests/support/turning_robot.hpp"

namespace surefoot::test {

/// Slow enough for a start: a robot that turns by 0.2 rad/s does not stand.
inline constexpr gaits::CalibrationOptions kMotion{
    .duration = 6.0, .settle = 0.5, .roll = 0.12, .pitch = 0.10, .yaw = 0.15};

inline constexpr gaits::CalibrationOptions kStill{
    .duration = 6.0, .settle = 0.5, .roll = 0.0, .pitch = 0.0, .yaw = 0.0};

inline TickContext standing() {
  TickContext context;
  for (FootContact& contact : context.contacts) contact.normal_force = 75.0;
  return context;
}

inline double tilt_error(const RobotState& state, const TurningRobot& robot) {
  return state.R_WB().row(2).cross(robot.R_WB().row(2)).norm();
}

}  // namespace surefoot::test
