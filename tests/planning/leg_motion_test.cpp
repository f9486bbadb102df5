#include "surefoot/planning/leg_motion.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
const Vec3 kUp = Vec3::UnitZ();
const Vec3 kNoForce = Vec3::Zero();

/// A leg and the foot that it moves.
struct Bench {
  Bench() = default;
  explicit Bench(const ForceOptions& force)
      : leg(SwingOptions{}, TouchdownOptions{}, force, kPeriod) {}

  LegEvent observe(const Vec3& force) {
    const Motion<Vec3> hip_motion{hip ? *hip : p + 0.3 * kUp, hip_velocity, Vec3::Zero()};
    const Vec3 v = foot_velocity ? *foot_velocity : leg.plan(time).v_WF;
    return leg.observe(time, {.hip = hip_motion,
                              .foot = {p, v, Vec3::Zero()},
                              .force = force,
                              .normal = kUp,
                              .force_per_torque = force_per_torque});
  }
  LegEvent observe(double normal_force) { return observe(normal_force * kUp); }

  /// The foot follows its reference, shifted, under a force, until something happens or `duration`
  /// is over.
  LegEvent follow(double duration, double normal_force, const Vec3& behind = Vec3::Zero()) {
    const double end = time + duration;
    LegEvent event = LegEvent::none;
    while (event == LegEvent::none && time < end - 0.5 * kPeriod) {
      time += kPeriod;
      p = leg.plan(time).p_WF + behind;
      event = observe(normal_force);
    }
    return event;
  }
  /// The foot stays where it is.
  LegEvent rest(double duration, double normal_force) {
    const double end = time + duration;
    LegEvent event = LegEvent::none;
    while (event == LegEvent::none && time < end - 0.5 * kPeriod) {
      time += kPeriod;
      event = observe(normal_force);
    }
    return event;
  }

  LegMotion leg{SwingOptions{}, TouchdownOptions{}, ForceOptions{}, kPeriod};
  double time = 10.0;
  Vec3 p{1.0, 2.0, 0.03};
  std::optional<Vec3> hip;  // without one the leg is never too short
  Vec3 hip_velocity = Vec3::Zero();
  double force_per_torque = 0.0;      // [1/m]
  std::optional<Vec3> foot_velocity;  // without one that of the reference
};

constexpr double kDuration = 0.5;  // of a swing [s]

/// A foot that has just left the ground for a step forward.
Bench swinging() {
  Bench bench;
  bench.leg.plant(bench.time - 5.0, bench.p);
  EXPECT_EQ(bench.observe(50.0), LegEvent::none);
  bench.leg.lift(bench.time, {bench.p, bench.p + Vec3(0.2, 0.0, 0.0), kUp, kDuration, 0.08});
  return bench;
}

/// A foot that is past its expected touchdown.
Bench searching() {
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(kDuration + 0.05, 0.0), LegEvent::none);
  EXPECT_EQ(bench.leg.phase(), LegPhase::search);
  return bench;
}

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
    bench.foot_velocity = asked + speed * options.bounce_speed * kUp;
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

TEST(LegMotion, GivesUpWhenTheSearchIsDeepEnough) {
  const SwingOptions options;
  Bench bench = swinging();
  const double begin = bench.time;
  EXPECT_EQ(bench.follow(100.0, 0.0), LegEvent::unreachable);
  EXPECT_NEAR(bench.time - begin, kDuration + options.search_depth_max / options.touchdown_speed,
              2.0 * kPeriod);
}

TEST(LegMotion, TheSearchWaitsForAFootThatStaysBehindAndThenGivesUp) {
  Bench bench = searching();
  const double begin = bench.time;
  double furthest = 0.0;
  LegEvent event = LegEvent::none;
  while (event == LegEvent::none && bench.time < begin + 5.0) {
    event = bench.rest(kPeriod, 0.0);  // at the end of its reach
    furthest = std::max(furthest, (bench.p - bench.leg.plan(bench.time).p_WF).norm());
  }
  EXPECT_EQ(event, LegEvent::unreachable);
  EXPECT_LT(bench.time - begin, 1.0);
  EXPECT_LT(furthest, 0.025);
}

TEST(LegMotion, TheSearchSlowsDownAndGivesUpBeforeTheLegIsStraight) {
  const SwingOptions options;
  Bench bench = searching();
  bench.hip = bench.p + Vec3(0.0, 0.0, options.reach_max - 0.10);
  double speed = options.touchdown_speed;
  LegEvent event = LegEvent::none;
  while (event == LegEvent::none) {
    event = bench.follow(kPeriod, 0.0);
    const double extension = (bench.p - *bench.hip).norm();
    ASSERT_LE(extension, options.reach_max + 1e-9);
    const double now = bench.leg.plan(bench.time).v_WF.norm();
    ASSERT_LE(now, speed + 1e-9) << "never faster again";
    speed = now;
  }
  EXPECT_EQ(event, LegEvent::unreachable);
  EXPECT_GT((bench.p - *bench.hip).norm(), options.reach_max - 0.01);
}

TEST(LegMotion, AFootIsNeverAskedForWhatItsLegCannotReach) {
  const SwingOptions options;
  Bench bench = searching();
  bench.hip = bench.p + Vec3(0.1, 0.1, options.reach_max - 0.10);
  bench.hip_velocity = Vec3(0.05, 0.0, 0.1);  // the torso leaves: the foot must come along
  Vec3 last = bench.p;
  double waited = 0.0;
  while (bench.follow(kPeriod, 0.0) == LegEvent::none) {
    const FootPlan plan = bench.leg.plan(bench.time);
    ASSERT_LE((plan.p_WF - *bench.hip).norm(), options.reach_max + 1e-9);
    const double unexplained = (plan.p_WF - last - kPeriod * plan.v_WF).norm();
    ASSERT_LT(unexplained, kPeriod * 0.15) << "velocity and place agree to the tick of the change";
    last = plan.p_WF;
    *bench.hip += kPeriod * bench.hip_velocity;
    waited += kPeriod;
    ASSERT_LT(waited, 5.0);
  }
}

TEST(LegMotion, ASearchThatIsHeldUpForAMomentGoesOn) {
  Bench bench = searching();
  EXPECT_EQ(bench.rest(0.3, 0.0), LegEvent::none);
  EXPECT_EQ(bench.follow(0.15 / SwingOptions{}.touchdown_speed, 0.0), LegEvent::none);
  EXPECT_EQ(bench.rest(0.3, 0.0), LegEvent::none);
  EXPECT_EQ(bench.follow(kPeriod, 50.0), LegEvent::touchdown);
}

TEST(LegMotion, LosesItsContactAfterATimeWithoutForce) {
  const TouchdownOptions options;
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  EXPECT_EQ(bench.rest(1.0, 1.1 * options.lost_force), LegEvent::none);
  EXPECT_EQ(bench.rest(options.lost_duration - kPeriod, 0.0), LegEvent::none);
  EXPECT_EQ(bench.rest(3.0 * kPeriod, 0.0), LegEvent::lost);
}

TEST(LegMotion, AMomentWithForceStartsTheTimeAnew) {
  const TouchdownOptions options;
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(bench.rest(options.lost_duration - kPeriod, 0.0), LegEvent::none);
    EXPECT_EQ(bench.rest(kPeriod, 5.0), LegEvent::none);
  }
}

TEST(LegMotion, AFootThatIsUnloadedOnPurposeIsNotLost) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  bench.leg.unload(bench.time + 0.15);
  EXPECT_EQ(bench.rest(1.0, 0.0), LegEvent::none);
  EXPECT_TRUE(bench.leg.unloaded());
  EXPECT_EQ(bench.rest(kPeriod, 40.0), LegEvent::none);
  EXPECT_FALSE(bench.leg.unloaded());
}

TEST(LegMotion, TheFootholdOfAStanceWandersWithItsFootAndStaysDuringASwing) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  bench.p += Vec3(0.004, 0.0, 0.0);
  bench.rest(kPeriod, 50.0);
  const Vec3 last = bench.p;
  EXPECT_EQ(bench.leg.foothold(), last);
  EXPECT_EQ(bench.leg.plan(bench.time).p_WF, last);
  bench.leg.lift(bench.time, {last, last + Vec3(0.2, 0.0, 0.0), kUp, kDuration, 0.08});
  bench.follow(0.3, 0.0);
  EXPECT_EQ(bench.leg.foothold(), last);
}

TEST(LegMotion, ALostFootSearchesStraightDownFromWhereItIs) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  bench.leg.search(bench.time, bench.p, kUp);
  EXPECT_EQ(bench.leg.phase(), LegPhase::search);
  EXPECT_FALSE(bench.leg.down());
  const Vec3 start = bench.p;
  EXPECT_EQ(bench.follow(0.5, 0.0), LegEvent::none);
  EXPECT_LT((bench.p - (start - 0.5 * SwingOptions{}.touchdown_speed * kUp)).norm(), 2e-3);
  EXPECT_EQ(bench.follow(kPeriod, 50.0), LegEvent::touchdown);
}

/// A foot that has just come down: put down at once, or from an ordinary swing.
Bench landed(bool at_once) {
  Bench bench = swinging();
  EXPECT_EQ(bench.follow(0.3, 0.0), LegEvent::none);
  const FootPlan now = bench.leg.plan(bench.time);
  const Vec3 goal = bench.p - Vec3(0.0, 0.0, bench.p.z() - 0.03);
  bench.leg.lift(bench.time, {.start = now.p_WF,
                              .goal = goal,
                              .normal = kUp,
                              .duration = at_once ? 0.15 : 0.3,
                              .apex = 0.05,
                              .straight = at_once,
                              .velocity = now.v_WF});
  EXPECT_EQ(bench.follow(0.4, 0.0), LegEvent::none);
  EXPECT_EQ(bench.follow(kPeriod, 50.0), LegEvent::touchdown);
  bench.leg.plant(bench.time, bench.p);
  EXPECT_EQ(bench.rest(0.02, 50.0), LegEvent::none);
  return bench;
}

/// What a foot that stands is taken for that has moved `way` and goes with `velocity`, whatever
/// the estimated force.
LegEvent moves(Bench bench, const Vec3& way, const Vec3& velocity) {
  bench.p += way;
  bench.foot_velocity = velocity;
  return bench.rest(kPeriod, 50.0);
}

TEST(LegMotion, AFootPutDownAtOnceThatReboundsOrFliesOffIsLostAtOnce) {
  const Bench bench = landed(true);
  EXPECT_EQ(moves(bench, 0.006 * kUp, 0.3 * kUp), LegEvent::lost);
  EXPECT_EQ(moves(bench, 0.006 * kUp, 0.2 * kUp), LegEvent::none) << "its ground gives way";
  EXPECT_EQ(moves(bench, 0.004 * kUp, 0.3 * kUp), LegEvent::none) << "the estimate is unsure";
  EXPECT_EQ(moves(bench, -0.006 * kUp, -0.3 * kUp), LegEvent::none) << "it sinks in";
  const Vec3 aside = Vec3::UnitX();
  EXPECT_EQ(moves(bench, 0.021 * aside, 0.7 * aside), LegEvent::lost);
  EXPECT_EQ(moves(bench, -0.021 * kUp, -0.7 * kUp), LegEvent::lost) << "there was no ground";
  EXPECT_EQ(moves(bench, 0.021 * aside, 0.5 * aside), LegEvent::none) << "it slides";
  EXPECT_EQ(moves(bench, 0.019 * aside, 0.7 * aside), LegEvent::none);
}

TEST(LegMotion, OnlyAFootThatWasPutDownAtOnceAndShortlyAgoFlies) {
  EXPECT_EQ(moves(landed(false), 0.03 * kUp, 1.0 * kUp), LegEvent::none);
  Bench bench = landed(true);
  EXPECT_EQ(bench.rest(0.1, 50.0), LegEvent::none);
  EXPECT_EQ(moves(bench, 0.03 * kUp, 1.0 * kUp), LegEvent::none);
}

/// Ticks on, and holds every plan against the one before.
struct RampWatch {
  explicit RampWatch(Bench& watched) : bench(watched), last(bench.leg.plan(bench.time)) {}

  void run(double duration) {
    const ForceOptions force;
    const double shortest = std::min(force.ramp_up, force.ramp_down);
    const double fastest = 1.5 * force.max * kPeriod / shortest + 1e-9;  // of the smoothstep
    for (const double end = bench.time + duration; bench.time < end - 0.5 * kPeriod;) {
      bench.time += kPeriod;
      const FootPlan now = bench.leg.plan(bench.time);
      ASSERT_LE(std::abs(now.force_max - last.force_max), fastest) << bench.time;
      ASSERT_LE(now.force_min, now.force_max);
      ASSERT_LE(now.force_min, force.min);
      ASSERT_GE(now.force_min, 0.0);
      ASSERT_LE(now.force_max, force.max);
      last = now;
    }
  }

  Bench& bench;
  FootPlan last;
};

TEST(LegMotion, ForceLimitsRiseFromZeroAtTouchdownAndFallToZeroAtLiftOff) {
  const ForceOptions force;
  Bench bench;
  bench.leg.plant(bench.time, bench.p);
  RampWatch watch(bench);
  EXPECT_EQ(watch.last.force_max, 0.0);
  watch.run(force.ramp_up);
  EXPECT_NEAR(watch.last.force_max, force.max, 1e-9);
  EXPECT_EQ(watch.last.force_min, force.min);
  watch.run(0.4);
  EXPECT_EQ(watch.last.force_max, force.max);
  bench.leg.unload(bench.time + force.ramp_down);
  EXPECT_EQ(bench.leg.phase(), LegPhase::unloading);
  watch.run(force.ramp_down);
  EXPECT_NEAR(watch.last.force_max, 0.0, 1e-9);
  EXPECT_NEAR(watch.last.force_min, 0.0, 1e-9);
  watch.run(0.3);
  EXPECT_EQ(watch.last.force_max, 0.0);
}

TEST(LegMotion, ForceLimitsAreContinuousWhereUnloadingFollowsATouchdownAtOnce) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Bench bench;
    bench.leg.plant(bench.time, bench.p);
    RampWatch watch(bench);
    watch.run(random.uniform(0.0, 0.1));
    bench.leg.unload(bench.time + ForceOptions{}.ramp_down);
    watch.run(0.3);
  }
}

TEST(LegMotion, ForceLimitsAreContinuousWhereAnUnloadingIsTakenBackAtAnyTime) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    Bench bench;
    bench.leg.plant(bench.time, bench.p, true);
    RampWatch watch(bench);
    bench.leg.unload(bench.time + ForceOptions{}.ramp_down);
    watch.run(random.uniform(0.0, 0.4));
    bench.leg.reload(bench.time);
    EXPECT_EQ(bench.leg.phase(), LegPhase::stance);
    watch.run(0.3);
    EXPECT_EQ(watch.last.force_max, ForceOptions{}.max);
  }
}

TEST(LegMotion, AFootThatStoodFromLongBeforeHasNoRamp) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, ForceOptions{}.max);
}

TEST(LegMotion, WithoutRampsEveryFootThatIsDownMayCarryAll) {
  Bench bench(ForceOptions{.ramps = false});
  bench.leg.plant(bench.time, bench.p);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, ForceOptions{}.max);
  bench.leg.unload(bench.time + 0.1);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.2).force_max, ForceOptions{}.max);
  bench.leg.lift(bench.time, {bench.p, bench.p, kUp, kDuration, 0.08});
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1).force_max, 0.0);
}

TEST(LegMotion, RampsOfNoLengthAreSteps) {
  Bench bench(ForceOptions{.ramp_up = 0.0, .ramp_down = 0.0});
  bench.leg.plant(bench.time, bench.p);
  EXPECT_EQ(bench.leg.plan(bench.time).force_max, 0.0);
  EXPECT_EQ(bench.leg.plan(bench.time + kPeriod).force_max, ForceOptions{}.max);
  bench.leg.unload(bench.time + 0.1);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1 - kPeriod).force_max, ForceOptions{}.max);
  EXPECT_EQ(bench.leg.plan(bench.time + 0.1).force_max, 0.0);
}

}  // namespace
}  // namespace surefoot
