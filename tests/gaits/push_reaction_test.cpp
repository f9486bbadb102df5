#include "surefoot/signals/sensor_reading.hpp"
#include "tests/gaits/puppet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot::gaits {
namespace {

using test::Puppet;

constexpr double kStrong = 110.0;     // [N]
constexpr double kTooStrong = 240.0;  // to be borne by a lean alone [N]

const Vec3 kPush(0.5 * kStrong, kStrong, 0.0);  // tips it over a left foot in the air

/// Walks until this leg has been in the air for so many ticks.
void walk_into_swing(Puppet& puppet, Leg leg, int most = 40) {
  puppet.user = {.walk = true, .velocity = {0.05, 0.0}};
  int ticks = 0;
  while (ticks < most && puppet.time() < 20.0) {
    puppet.tick();
    ticks = puppet.plan().contact(leg) ? 0 : ticks + 1;
  }
  ASSERT_EQ(ticks, most);
}

TEST(PushReaction, StandingLeansAgainstAPush) {
  const PlannerOptions options;
  Puppet puppet(options);
  puppet.push = {0.0, 30.0, 0.0};
  puppet.run(4.0);
  const double lean = options.stance.height * 30.0 / Puppet::kWeight;
  EXPECT_NEAR(puppet.com().y(), -lean, 0.005);
  EXPECT_NEAR(puppet.com().x(), 0.0, 0.005);
  EXPECT_NEAR(puppet.plan().com.zmp.y(), 0.0, 0.005);
}

TEST(PushReaction, StandsUprightAgainWhenThePushIsOver) {
  Puppet puppet;
  puppet.push = {20.0, 20.0, 0.0};
  puppet.run(3.0);
  ASSERT_GT(puppet.com().norm(), 0.02);
  puppet.push.setZero();
  puppet.run(4.0);
  EXPECT_LT(puppet.com().norm(), 0.005);
}

TEST(PushReaction, AFootInTheAirComesDownAtOnceWhenTheRobotTipsOverIt) {
  const PlannerOptions options;
  Puppet puppet(options);
  walk_into_swing(puppet, Leg::LF);
  const double pushed_at = puppet.time();
  puppet.push = kPush;
  puppet.run(options.push.foot_down_duration + 0.05);
  ASSERT_GE(puppet.happenings(PlanEvent::push_foot_down).size(), 1u);
  EXPECT_LT(puppet.happenings(PlanEvent::push_foot_down).front().time, pushed_at + 0.02);
  EXPECT_TRUE(puppet.plan().contact(Leg::LF));
}

TEST(PushReaction, AFootThatIsPutDownGoesOnWithItsSpeedAndLandsSoon) {
  const double duration = PushOptions{}.foot_down_duration;
  for (const int ticks : {20, 40, 70, 100, 120}) {  // of the swing, when it is pushed
    SCOPED_TRACE(std::to_string(ticks) + " ticks");
    Puppet puppet;
    walk_into_swing(puppet, Leg::LF, ticks);
    puppet.push = kPush;
    FootPlan before = puppet.plan().feet[index(Leg::LF)];
    while (puppet.happenings(PlanEvent::push_foot_down).empty() && puppet.time() < 30.0) {
      before = puppet.plan().feet[index(Leg::LF)];
      puppet.tick();
    }
    const double put_down_at = puppet.time();
    ASSERT_GT(before.v_WF.norm(), 0.1) << "it is in motion";
    const FootPlan now = puppet.plan().feet[index(Leg::LF)];
    EXPECT_LT((now.p_WF - before.p_WF - Puppet::kPeriod * before.v_WF).norm(), 1e-9);
    EXPECT_LT((now.v_WF - before.v_WF).norm(), 1e-9);
    double hardest = 0.0;  // [m/s²]
    while (!puppet.plan().contact(Leg::LF) && puppet.time() < put_down_at + 1.0) {
      hardest = std::max(hardest, puppet.plan().feet[index(Leg::LF)].a_WF.norm());
      puppet.tick();
    }
    EXPECT_LT(hardest, 45.0) << "of what drives give a foot";
    EXPECT_LT(puppet.time() - put_down_at, 2.0 * duration);
  }
}

TEST(PushReaction, TheGaitWaitsUntilARobotThatWasPushedIsCalmAndThenGoesOn) {
  constexpr double kCalm = 0.06;  // [m/s]
  Puppet puppet;
  walk_into_swing(puppet, Leg::LH);  // after it a leg of the same side would be due soon
  puppet.push = 0.8 * Vec3(-0.5 * kStrong, kStrong, 0.0);
  puppet.run(0.6);
  ASSERT_EQ(puppet.happenings(PlanEvent::push_foot_down).size(), 1u);
  ASSERT_EQ(puppet.plan().num_contacts(), 4);
  puppet.push.setZero();
  puppet.run(0.1);  // the robot is on its way back
  const double freed_at = puppet.time();
  const std::size_t steps = puppet.happenings(PlanEvent::lift_off).size();
  const auto lifted = [&] { return puppet.happenings(PlanEvent::lift_off).size() > steps; };
  double calm_at = kNaN;
  bool unloaded_early = false;
  while (!lifted() && puppet.time() < freed_at + 5.0) {
    const Vec2 before = puppet.com();
    puppet.tick();
    const double speed = (puppet.com() - before).norm() / Puppet::kPeriod;
    if (std::isnan(calm_at) && speed < kCalm) calm_at = puppet.time();
    for (const FootPlan& foot : puppet.plan().feet)
      unloaded_early |= std::isnan(calm_at) && foot.phase == LegPhase::unloading;
  }
  EXPECT_GT(calm_at, freed_at + Puppet::kPeriod) << "it was not calm from the beginning";
  EXPECT_FALSE(unloaded_early);
  EXPECT_GE(puppet.time(), calm_at + GaitOptions{}.switch_duration - Puppet::kPeriod);
  puppet.run(10.0);
  EXPECT_GT(puppet.happenings(PlanEvent::lift_off).size(), steps + 8) << "it walks on";
}

TEST(PushReaction, ASmallPushLetsASwingGoOn) {
  Puppet puppet;
  walk_into_swing(puppet, Leg::LF);
  puppet.push = {0.0, 5.0, 0.0};
  puppet.run(0.5);
  EXPECT_TRUE(puppet.happenings(PlanEvent::push_foot_down).empty());
}

TEST(PushReaction, ALegThatUnloadsCarriesAgainWhileTheForceChanges) {
  Puppet puppet;
  puppet.user = {.walk = true, .velocity = {0.05, 0.0}};
  while (puppet.plan().feet[index(Leg::LH)].phase != LegPhase::unloading && puppet.time() < 20.0)
    puppet.tick();
  puppet.push = {0.0, 40.0, 0.0};
  puppet.tick();
  EXPECT_EQ(puppet.happenings(PlanEvent::push_reloaded).size(), 1u);
  EXPECT_EQ(puppet.plan().feet[index(Leg::LH)].phase, LegPhase::stance);
}

TEST(PushReaction, StepsAheadOfTheCapturePointThatLeavesTheFeet) {
  for (const double way : {1.0, -1.0}) {
    Puppet puppet;
    puppet.run(0.5);
    puppet.push = {way * kTooStrong, 0.0, 0.0};
    puppet.run(0.4);
    const auto steps = puppet.happenings(PlanEvent::push_step);
    ASSERT_GE(steps.size(), 1u);
    const Leg leg = steps.front().leg;
    EXPECT_EQ(is_front(leg), way > 0.0);
    EXPECT_GT(way * puppet.foot(leg).x(), StanceOptions{}.half_length + 0.03);
    EXPECT_TRUE(puppet.plan().contact(leg));
  }
}

TEST(PushReaction, TakesNoStepThatDoesNotHelpNorWhereLeaningIsEnoughNorSwitchedOff) {
  struct Case {
    Vec3 push;
    double duration;  // [s]
    bool steps;
  };
  for (const Case& one :
       {Case{{0.0, 1.2 * kStrong, 0.0}, 0.1, true},  // capture point just within the left feet
        Case{{20.0, 50.0, 0.0}, 2.0, true}, Case{{kTooStrong, 0.0, 0.0}, 0.4, false}}) {
    PlannerOptions options;
    options.push.steps = one.steps;
    Puppet puppet(options);
    puppet.run(0.5);
    puppet.push = one.push;
    puppet.run(one.duration);
    EXPECT_TRUE(puppet.happenings(PlanEvent::push_step).empty()) << one.push.transpose();
  }
}

TEST(PushReaction, WalksOnMoreSlowlyAgainstAPush) {
  Puppet free, pushed;
  for (Puppet* puppet : {&free, &pushed}) puppet->user = {.walk = true, .velocity = {0.08, 0.0}};
  pushed.push = {0.0, 40.0, 0.0};
  free.run(12.0);
  pushed.run(12.0);
  EXPECT_GT(pushed.com().x(), 0.2 * free.com().x());
  EXPECT_LT(pushed.com().x(), 0.8 * free.com().x());
}

TEST(PushReaction, DoesNothingWhenItIsSwitchedOff) {
  PlannerOptions options;
  options.push.enabled = false;
  Puppet puppet(options);
  walk_into_swing(puppet, Leg::LF);
  puppet.push = kPush;
  puppet.run(0.3);
  EXPECT_TRUE(puppet.happenings(PlanEvent::push_foot_down).empty());
}

TEST(PushReaction, AWalkGoesOnAfterASlipThoughItIsSwitchedOff) {
  PlannerOptions options;
  options.push.enabled = false;
  Puppet puppet(options);
  walk_into_swing(puppet, Leg::LF);
  puppet.blow = {0.3, 0.3};  // the balance needs the foot
  puppet.tick();
  puppet.slide[index(Leg::RH)] = Vec2(30.0, 0.0);
  puppet.run(0.05);
  puppet.slide.fill(Vec2::Zero());
  puppet.blow.setZero();
  ASSERT_FALSE(puppet.happenings(PlanEvent::slip).empty());
  const auto lifts = [&] { return puppet.happenings(PlanEvent::lift_off).size(); };
  puppet.run(0.2);
  ASSERT_EQ(puppet.plan().num_contacts(), 4) << "it is put down";
  const std::size_t before = lifts();
  puppet.run(15.0);
  EXPECT_GT(lifts(), before + 2);
}

TEST(PushReaction, AStepWhileTheRobotCalibratesItselfDoesNotBeginTheWalk) {
  PlannerOptions options;
  options.calibration.duration = 6.0;
  Puppet puppet(options);
  puppet.user = {.walk = true, .velocity = {0.05, 0.0}};
  puppet.run(1.5);
  puppet.push = {kTooStrong, 0.0, 0.0};
  puppet.run(0.4);
  ASSERT_GE(puppet.happenings(PlanEvent::push_step).size(), 1u);
  puppet.push.setZero();
  puppet.run(4.0);
  ASSERT_NE(puppet.plan().calibration, CalibrationStage::none);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off).empty());
}

TEST(PushReaction, TheOtherFeetCarryWhileOneSteps) {
  PlannerOptions options;
  options.push.unsteady = 1e9;  // or the leg would be loaded again because the force changes
  Puppet puppet(options);
  puppet.user = {.walk = true, .velocity = {0.05, 0.0}};
  while (puppet.plan().feet[index(Leg::LH)].phase != LegPhase::unloading && puppet.time() < 20.0)
    puppet.tick();
  puppet.push = {kTooStrong, 0.0, 0.0};
  puppet.run(0.4, [&] {
    for (const Leg leg : kLegs) {
      if (puppet.happenings(PlanEvent::push_step).empty()) continue;
      EXPECT_NE(puppet.plan().feet[index(leg)].phase, LegPhase::unloading);
    }
  });
  EXPECT_GE(puppet.happenings(PlanEvent::push_step).size(), 1u);
}

TEST(PushReaction, NumbersThatAreNotFiniteAreNoPush) {
  Puppet puppet;
  puppet.push = {std::nan(""), 0.0, 0.0};
  puppet.run(1.0, [&] { ASSERT_TRUE(puppet.plan().com.p.allFinite()); });
  EXPECT_LT(puppet.com().norm(), 0.005);
}

}  // namespace
}  // namespace surefoot::gaits
