#pragma once

#include "surefoot/control/safety.hpp"
#include "surefoot/math/rotation.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/sizes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::test {

inline constexpr int kFirstFreeLevel = 4;
inline constexpr double kPeriod = 0.0025;  // [s]
inline constexpr double kLimit = 40.0;     // of every joint of the robot [N·m]

inline RobotState standing(double time = 1.0) {
  RobotState state;
  state.time = time;
  state.p_WB = Vec3(0.0, 0.0, 0.46);
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = anymal_b().q_nominal;
  state.qd.setZero();
  state.torque.setZero();
  return state;
}

inline RobotState tilted(double roll) {
  RobotState state = standing();
  state.q_WB = from_roll_pitch_yaw({roll, 0.0, 0.3});
  return state;
}

inline JointVector torques(double first = 1.0) {
  return first * JointVector::LinSpaced(kNumLegJoints, 1.0, 2.1);
}

inline solver::Solution solved(const JointVector& torque,
                               solver::SolveStatus status = solver::SolveStatus::optimal,
                               int failed_level = -1) {
  solver::Solution solution;
  solution.status = status;
  solution.failed_level = failed_level;
  solution.x = VecX::Constant(kNumUnknowns, 99.0);
  solution.x.tail<kNumLegJoints>() = torque;
  return solution;
}

/// Where it sits down to: folded.
inline JointVector lying() { return 2.5 * anymal_b().q_nominal; }

inline control::Safety make_safety(const control::SafetyOptions& options = {}) {
  return control::Safety(options, anymal_b(), kFirstFreeLevel, lying(), kPeriod);
}

inline void expect_legal(const JointCommand& command) {
  ASSERT_TRUE(command.torque.allFinite());
  ASSERT_LE(command.torque.cwiseAbs().maxCoeff(), kLimit);
  ASSERT_TRUE(std::isfinite(command.time));
}

}  // namespace surefoot::test
