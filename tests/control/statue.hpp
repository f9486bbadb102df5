#pragma once

#include "surefoot/config/initial_posture.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/control/controller.hpp"
#include "surefoot/math/numbers.hpp"
#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace surefoot::test {

inline constexpr double kLimit = 40.0;  // of every joint of the robot [N·m]

/// Believes what the test says.
class ScriptedEstimator final : public estimation::StateEstimator {
 public:
  explicit ScriptedEstimator(const RobotState& state) : state_(state) {}
  const RobotState& update(const SensorReading&, const TickContext&) noexcept override {
    return state_;
  }
  void restart() noexcept override {}

 private:
  const RobotState& state_;
};

inline control::ControllerOptions options_of(const std::string& stack = "terrain_adaptation") {
  control::ControllerOptions options;
  options.stack = config::load_stack(stack);
  options.consistency.enabled = false;  // a statue's sensors do not fit each other
  return options;
}

inline RobotState standing(const gaits::StanceOptions& stance) {
  RobotState state;
  state.time = 0.0;
  state.p_WB = Vec3(0.0, 0.0, stance.height);
  state.q_WB = Quat::Identity();
  state.v_WB.setZero();
  state.w_WB_B.setZero();
  state.q = config::stance_posture(model::RobotModel(anymal_b()), stance);
  state.qd.setZero();
  state.torque.setZero();
  return state;
}

/// A robot that stands like a statue, and its controller. Its measured torques are the commanded
/// ones.
struct Statue {
  explicit Statue(const control::ControllerOptions& options = options_of())
      : period(options.period),
        state(standing(options.planner.stance)),
        controller(anymal_b(), options, std::make_unique<ScriptedEstimator>(state)) {}

  const JointCommand& tick() {
    state.time += period;
    reading.time = state.time;
    reading.q = state.q;
    reading.torque = state.torque;
    const JointCommand& command = controller.step(reading, user);
    state.torque = command.torque;
    return command;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) (void)tick();
  }
  /// One tick at which the estimator believes something else, under a legal command.
  const JointCommand& tick_with(const RobotState& believed) {
    const RobotState before = state;
    state = believed;
    reading.time = before.time + period;
    const JointCommand& command = controller.step(reading, user);
    state = before;
    state.time += period;
    return command;
  }

  double period;
  RobotState state;
  SensorReading reading;
  UserCommand user;
  control::Controller controller;
};

inline void expect_legal(const JointCommand& command) {
  ASSERT_TRUE(command.torque.allFinite());
  ASSERT_LE(command.torque.cwiseAbs().maxCoeff(), kLimit);
}

/// Could a robot follow it?
inline bool is_sound(const MotionPlan& plan) {
  bool sound = plan.com.p.norm() < 1.0 && plan.com.v.norm() < 1.0 && plan.com.a.norm() < 10.0 &&
               std::abs(plan.torso.height) < 2.0 && plan.torso.q_WB.coeffs().allFinite();
  for (const FootPlan& foot : plan.feet) sound = sound && foot.p_WF.norm() < 2.0;
  return sound;
}

}  // namespace surefoot::test
