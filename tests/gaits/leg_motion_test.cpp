#include "surefoot/gaits/parts/leg_motion.hpp"

#include "tests/gaits/leg_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace surefoot::gaits {
namespace {

using test::Bench;
using test::kDuration;
using test::kPeriod;
using test::kUp;
using test::searching;
using test::swinging;

TEST(LegMotion, SwingsAlongItsCurveWithoutForce) {
  Bench bench = swinging();
  const SwingCurve curve(bench.leg.target(), SwingOptions{});
  for (int i = 0; i < 190; ++i) {
    const FootPlan plan = bench.leg.plan(bench.time);
    const Motion<Vec3> reference = curve.at(i * kPeriod);
    ASSERT_LT((plan.p_WF - reference.p).norm(), 1e-9);
    ASSERT_LT((plan.v_WF - reference.v).norm(), 1e-9);
    ASSERT_LT((plan.a_WF - reference.a).norm(), 1e-9);
    ASSERT_EQ(plan.phase, LegPhase::swing);
    ASSERT_EQ(plan.force_max, 0.0);
    ASSERT_EQ(plan.force_min, 0.0);
    bench.follow(kPeriod, 0.0);
  }
  EXPECT_FALSE(bench.leg.down());
}

TEST(LegMotion, AsksForTheAccelerationAheadOfTheMotion) {
  PlannerOptions options;
  options.swing.lead = 0.01;
  LegMotion ahead(options, kPeriod), exact({}, kPeriod);
  for (LegMotion* leg : {&ahead, &exact})
    leg->lift(0.0, {.goal = 0.3 * Vec3::UnitX(), .duration = 0.3});
  EXPECT_EQ(ahead.plan(0.1).p_WF, exact.plan(0.1).p_WF);
  EXPECT_EQ(ahead.plan(0.1).v_WF, exact.plan(0.1).v_WF);
  EXPECT_EQ(ahead.plan(0.1).a_WF, exact.plan(0.1 + 0.01).a_WF);
  EXPECT_NE(ahead.plan(0.1).a_WF, exact.plan(0.1).a_WF);
}

TEST(LegMotion, TouchesDownAfterTwoTicksOfForce) {
  const TouchdownOptions options;
  Bench bench = searching();
  EXPECT_EQ(bench.follow(1.0, 0.99 * options.stall_force, Vec3(0.0, 0.0, 0.01)), LegEvent::none);
  Bench light = searching();
  EXPECT_EQ(light.follow(0.5, 0.99 * options.touchdown_force), LegEvent::none);
  EXPECT_EQ(light.follow(kPeriod, 1.01 * options.touchdown_force), LegEvent::none);
  EXPECT_EQ(light.follow(kPeriod, 1.01 * options.touchdown_force), LegEvent::touchdown);
}

TEST(LegMotion, OneTickOfLightForceIsNoTouchdown) {
  Bench bench = searching();
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(bench.follow(kPeriod, 20.0), LegEvent::none);
    EXPECT_EQ(bench.follow(kPeriod, 0.0), LegEvent::none);
  }
}

TEST(LegMotion, AnImpactIsATouchdownAtOnce) {
  Bench bench = searching();
  EXPECT_EQ(bench.follow(kPeriod, 100.0), LegEvent::touchdown);
}

TEST(LegMotion, AFootThatFliesOnInTheMiddleOfASwingHasMetNothing) {
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(0.6 * kDuration, 0.0), LegEvent::none);
  bench.foot_velocity = 1.1 * Vec3::UnitX();
  EXPECT_EQ(bench.follow(0.05, 15.0), LegEvent::none);
  bench.foot_velocity = 0.9 * Vec3::UnitX();
  EXPECT_EQ(bench.follow(0.05, 15.0), LegEvent::touchdown) << "it was slowed down";
}

TEST(LegMotion, AtTheEndOfASwingAFastFootMayHaveCome) {
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(0.85 * kDuration, 0.0), LegEvent::none);
  bench.foot_velocity = 1.1 * Vec3::UnitX();
  EXPECT_EQ(bench.follow(0.05, 15.0), LegEvent::touchdown);
}

TEST(LegMotion, AStraightLegsTorquesAreDoubted) {
  const TouchdownOptions options;
  Bench bench = searching();
  bench.force_per_torque = 3.0 * options.touchdown_force / options.torque_error;
  EXPECT_EQ(bench.follow(0.2, 2.9 * options.touchdown_force), LegEvent::none);
  EXPECT_EQ(bench.follow(2 * kPeriod, 3.1 * options.touchdown_force), LegEvent::touchdown);
}

TEST(LegMotion, AFootThatBouncesHasTouched) {
  const TouchdownOptions options;
  const auto bounces = [&](double speed, double force) {
    Bench bench = searching();
    const Vec3 asked = bench.leg.plan(bench.time).v_WF;
    bench.foot_velocity = asked;
    bench.follow(0.3, -1.0);
    const double stopped = std::max(options.bounce_speed, 0.5 * asked.norm());
    bench.foot_velocity = asked + speed * stopped * kUp;
    return bench.follow(2 * kPeriod, -1.0 + force * options.bounce_force) == LegEvent::touchdown;
  };
  EXPECT_TRUE(bounces(1.1, 1.3));
  EXPECT_FALSE(bounces(0.9, 1.3));
  EXPECT_FALSE(bounces(1.1, 0.9));
}

TEST(LegMotion, AFootWhoseForceIsAlwaysWrongHasNotBounced) {
  const TouchdownOptions options;
  Bench bench = searching();
  const Vec3 asked = bench.leg.plan(bench.time).v_WF;
  bench.foot_velocity = asked;
  bench.follow(0.3, 3.0 * options.bounce_force);
  bench.foot_velocity = asked + 2.0 * options.bounce_speed * kUp;
  EXPECT_EQ(bench.follow(3 * kPeriod, 3.0 * options.bounce_force), LegEvent::none);
}

TEST(LegMotion, AFootThatLagsMoreAndMoreHasNotBounced) {
  const TouchdownOptions options;
  Bench bench = searching();
  const Vec3 asked = bench.leg.plan(bench.time).v_WF;
  for (int i = 0; i < 30; ++i) {
    bench.foot_velocity = asked + 0.15 * i * options.bounce_speed * kUp;
    EXPECT_EQ(bench.follow(kPeriod, 0.15 * i * options.bounce_force), LegEvent::none) << i;
  }
}

/// Does a foot touch that comes to rest with its reference, a few ticks after it, under a force
/// that rises meanwhile?
bool touches_as_it_stops(Bench& bench) {
  const TouchdownOptions options;
  constexpr int kLate = 4;  // [ticks]
  std::vector<Vec3> asked;
  for (int i = 0; i < 80; ++i) {
    asked.push_back(bench.leg.plan(bench.time).v_WF);
    bench.foot_velocity = asked[static_cast<std::size_t>(std::max(0, i - kLate))];
    const double stopped = bench.foot_velocity->z() - asked.front().z();
    const double force = stopped > options.bounce_speed ? 2.0 * options.bounce_force : 0.0;
    if (bench.follow(kPeriod, force) != LegEvent::none) return true;
  }
  return false;
}

TEST(LegMotion, AFootThatStopsWithItsReferenceAtTheEndOfItsReachHasNotBounced) {
  Bench bench = swinging();
  bench.leg.lift(bench.time, {bench.p, bench.p - 0.3 * kUp, kUp, kDuration, 0.08});
  ASSERT_EQ(bench.follow(0.88 * kDuration, 0.0), LegEvent::none);
  ASSERT_LT(bench.leg.plan(bench.time).v_WF.z(), -2.0 * TouchdownOptions{}.bounce_speed);
  bench.hip = bench.p + (SwingOptions{}.reach_max - 0.001) * kUp;
  EXPECT_FALSE(touches_as_it_stops(bench));
}

TEST(LegMotion, AFootHasBouncedBeyondTheEndOfItsReachToo) {
  Bench bench = searching();
  bench.hip = bench.p + (SwingOptions{}.reach_max - 0.001) * kUp;
  bench.foot_velocity = Vec3::Zero();
  ASSERT_EQ(bench.follow(0.2, 0.0), LegEvent::none);
  const TouchdownOptions options;
  bench.foot_velocity = 1.1 * options.bounce_speed * kUp;
  EXPECT_EQ(bench.follow(2 * kPeriod, 1.3 * options.bounce_force), LegEvent::touchdown);
}

TEST(LegMotion, ComesBackIntoReachWithoutAJumpOfItsVelocity) {
  Bench bench = swinging();
  bench.hip = bench.p + Vec3(0.48, 0.0, 0.33);
  ASSERT_GT((bench.p - *bench.hip).norm(), SwingOptions{}.reach_max + 0.02);
  Vec3 before = bench.leg.plan(bench.time).v_WF;
  while (bench.time < 10.0 + 0.8 * kDuration) {
    ASSERT_EQ(bench.follow(kPeriod, 0.0), LegEvent::none);
    const Vec3 now = bench.leg.plan(bench.time).v_WF;
    ASSERT_LT((now - before).norm(), 0.06) << bench.time;
    before = now;
  }
  EXPECT_LT((bench.p - *bench.hip).norm(), SwingOptions{}.reach_max - 0.05);
}

TEST(LegMotion, TouchesDownWhereItStallsUnderASmallForce) {
  const TouchdownOptions options;
  Bench bench = searching();
  const Vec3 close(0.0, 0.0, 0.9 * options.stall_error);
  EXPECT_EQ(bench.follow(0.2, 1.1 * options.stall_force, close), LegEvent::none);
  const Vec3 behind(0.0, 0.0, 1.1 * options.stall_error);
  EXPECT_EQ(bench.follow(kPeriod, 1.1 * options.stall_force, behind), LegEvent::none);
  EXPECT_EQ(bench.follow(kPeriod, 1.1 * options.stall_force, behind), LegEvent::touchdown);
}

TEST(LegMotion, FeelsOnlyTheForceAlongTheNormal) {
  Bench bench = searching();
  for (int i = 0; i < 20; ++i) {
    bench.time += kPeriod;
    bench.p = bench.leg.plan(bench.time).p_WF;
    EXPECT_EQ(bench.observe(Vec3(100.0, -100.0, 0.0)), LegEvent::none);
  }
}

TEST(LegMotion, BelievesNoTouchdownBeforeItIsArmed) {
  const double armed = SwingOptions{}.armed_after * kDuration;
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(armed - kPeriod, 500.0), LegEvent::none);
  EXPECT_NE(bench.follow(3.0 * kPeriod, 500.0), LegEvent::none);
  EXPECT_EQ(bench.leg.phase(), LegPhase::swing) << "an early touchdown";
}

}  // namespace
}  // namespace surefoot::gaits
