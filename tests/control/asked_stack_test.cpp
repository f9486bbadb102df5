#include "surefoot/control/asked_stack.hpp"

#include "tests/control/statue.hpp"
#include "tests/support/malloc_counter.hpp"

namespace surefoot::control {
namespace {

/// A statue that stands, and a stack that is asked beside its controller.
struct Beside {
  explicit Beside(const std::string& stack = "terrain_adaptation")
      : asked(config::load_stack(stack), options.solver, options.safety, test::anymal_b()) {
    statue.run(20);
  }

  const StackAnswer& ask() { return asked.ask(state(), dynamics(), plan()); }
  [[nodiscard]] const RobotState& state() const { return statue.controller.record().state; }
  [[nodiscard]] const MotionPlan& plan() const { return statue.controller.record().plan; }
  [[nodiscard]] const model::Dynamics& dynamics() const { return *statue.controller.dynamics(); }
  [[nodiscard]] MotionPlan plan_of_no_sense() const {
    MotionPlan plan = this->plan();
    plan.com.p.setConstant(kNaN);
    return plan;
  }

  ControllerOptions options = test::options_of();
  test::Statue statue{options};
  AskedStack asked;
};

TEST(AskedStack, of_the_controllers_own_levels_answers_what_the_controller_commands) {
  Beside beside;
  for (int tick = 0; tick < 50; ++tick) {
    beside.statue.run(1);
    const StackAnswer& answer = beside.ask();
    ASSERT_TRUE(answer.is_usable());
    ASSERT_LT((answer.command.torque - beside.statue.controller.record().command.torque).norm(),
              1e-9);
  }
}

TEST(AskedStack, has_names_and_units_of_its_own_levels) {
  const Beside beside("regular");
  ASSERT_EQ(beside.asked.level_names().size(), config::load_stack("regular").levels.size());
  EXPECT_EQ(beside.asked.level_names().at(1), "no_contact_motion");
  EXPECT_EQ(beside.asked.level_units().at(1), "m/s²");
}

TEST(AskedStack, answers_behind_ticks_that_would_have_stopped_its_controller) {
  Beside beside;
  const JointVector good = beside.ask().command.torque;
  const MotionPlan plan = beside.plan_of_no_sense();
  const int patience = beside.options.safety.damp_after_failures;
  for (int tick = 1; tick <= 3 * patience; ++tick) {
    const StackAnswer& answer = beside.asked.ask(beside.state(), beside.dynamics(), plan);
    ASSERT_FALSE(answer.is_usable());
    ASSERT_EQ(answer.hierarchy.status, static_cast<int>(solver::SolveStatus::invalid_input));
    ASSERT_EQ(answer.command.cause, tick <= patience ? StopCause::none : StopCause::failures);
  }
  EXPECT_TRUE(beside.ask().is_usable());
  EXPECT_LT((beside.ask().command.torque - good).norm(), 1e-9);
  for (int tick = 1; tick <= patience; ++tick)
    EXPECT_EQ(beside.asked.ask(beside.state(), beside.dynamics(), plan).command.cause,
              StopCause::none)
        << "failures in a row count anew";
}

TEST(AskedStack, is_stopped_by_a_torso_that_leans_too_far_at_that_tick_alone) {
  Beside beside;
  RobotState tilted = beside.state();
  tilted.q_WB = Quat(Eigen::AngleAxisd(2.0, Vec3::UnitX()));
  for (int tick = 0; tick < 3; ++tick) {
    EXPECT_EQ(beside.asked.ask(tilted, beside.dynamics(), beside.plan()).command.cause,
              StopCause::tilt);
    EXPECT_TRUE(beside.ask().is_usable());
  }
}

TEST(AskedStack, does_not_allocate) {
  Beside beside;
  const MotionPlan plan = beside.plan_of_no_sense();
  (void)beside.ask();
  const test::MallocCounter counter;
  for (int tick = 0; tick < 200; ++tick)
    (void)beside.asked.ask(beside.state(), beside.dynamics(), plan);
  (void)beside.ask();
  EXPECT_EQ(counter.count(), 0U);
}

TEST(Controller, has_no_model_of_a_tick_whose_state_it_refused) {
  Beside beside;
  ASSERT_NE(beside.statue.controller.dynamics(), nullptr);
  RobotState lost = beside.statue.state;
  lost.p_WB.setConstant(kNaN);
  (void)beside.statue.tick_with(lost);
  EXPECT_EQ(beside.statue.controller.dynamics(), nullptr);
  beside.statue.run(1);
  EXPECT_NE(beside.statue.controller.dynamics(), nullptr);
}

}  // namespace
}  // namespace surefoot::control
