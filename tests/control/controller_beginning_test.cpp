// A controller whose first reading is contradicted by the second.
#include "surefoot/signals/plan_event.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/event_kinds.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

namespace surefoot::control {
namespace {

using test::Statue;

/// The next tick is at this time; no torques are measured, so that nothing but plans can differ.
void tick_at(Statue& statue, double time) {
  statue.state.time = time - statue.period;
  statue.state.torque.setZero();
  (void)statue.tick();
}

ControllerOptions with_a_switch() {
  ControllerOptions options = test::options_of();
  options.level_switches = {{.time = 1.0, .remove = {"torso_roll_pitch"}, .duration = 0.5}};
  return options;
}

TEST(ControllerBeginning, WhatWasBegunWithAWrongReadingIsForgotten) {
  for (const bool is_clock : {false, true}) {
    Statue right(with_a_switch()), wrong(with_a_switch());
    for (Statue* statue : {&right, &wrong}) {
      statue->user.walk = true;
      statue->user.velocity.x() = 0.1;
      statue->reading.gyro.setZero();
      statue->reading.accelerometer = -kGravityVector;
    }
    const RobotState stands = wrong.state;
    if (!is_clock) wrong.state.q.array() += 0.3;
    wrong.state.p_WB.x() = 5.0;
    tick_at(wrong, is_clock ? 1000.0 : -wrong.period);
    wrong.state = stands;
    const test::MallocCounter counter;
    tick_at(wrong, 0.0);
    EXPECT_EQ(counter.count(), 0U);
    EXPECT_TRUE(wrong.controller.record().plan.events.has(PlanEvent::begun_anew));
    EXPECT_TRUE(is_clock || wrong.controller.record().health.encoders.fault == SampleFault::jump)
        << "it is told";
    tick_at(right, 0.0);
    for (int tick = 1; tick < 1200; ++tick) {
      tick_at(right, tick * right.period);
      tick_at(wrong, tick * wrong.period);
      const MotionPlan &plan = wrong.controller.record().plan,
                       &expected = right.controller.record().plan;
      ASSERT_EQ(wrong.controller.record().hierarchy.transition_share,
                right.controller.record().hierarchy.transition_share)
          << tick;
      ASSERT_EQ(test::kinds_of(plan.events), test::kinds_of(expected.events)) << tick;
      ASSERT_EQ(plan.com.p, expected.com.p) << tick;
      ASSERT_EQ(plan.torso.q_WB.coeffs(), expected.torso.q_WB.coeffs()) << tick;
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        ASSERT_EQ(plan.feet[k].p_WF, expected.feet[k].p_WF) << tick;
      }
    }
    EXPECT_EQ(wrong.controller.record().command.torque, right.controller.record().command.torque);
  }
}

TEST(ControllerBeginning, ADriverThatIsDeadBehindItIsLost) {
  Statue statue;
  tick_at(statue, 1000.0);
  tick_at(statue, 0.0);
  EXPECT_TRUE(statue.controller.record().plan.events.has(PlanEvent::begun_anew));
  for (int tick = 0; tick < 12; ++tick) {
    tick_at(statue, 0.0);
    EXPECT_TRUE(statue.controller.record().plan.events.empty());
  }
  EXPECT_NE(statue.controller.record().command.cause, StopCause::none);
}

}  // namespace
}  // namespace surefoot::control
