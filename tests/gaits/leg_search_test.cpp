#include "surefoot/gaits/parts/leg_motion.hpp"
#include "tests/gaits/leg_bench.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::gaits {
namespace {

using test::Bench;
using test::kDuration;
using test::kPeriod;
using test::kSwing;
using test::kUp;
using test::searching;
using test::swinging;

TEST(LegMotion, GivesUpWhenTheSearchHasTakenTheHipDownFarEnough) {
  for (const double lower : {0.001, -0.001}) {
    Bench bench = searching();
    bench.follow(0.2, 0.0);
    bench.hip = bench.leg.foothold() + (kSwing.hip_height_min - lower) * kUp;
    EXPECT_EQ(bench.follow(2.0 * kPeriod, 0.0) == LegEvent::unreachable, lower > 0.0);
  }
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
  const double begin = bench.time;
  LegEvent event = LegEvent::none;
  while (event == LegEvent::none && bench.time < begin + 5.0) {
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

Bench searching_fast() {
  PlannerOptions options;
  options.swing = kSwing;
  options.swing.search_speed = 1.0;
  Bench bench = swinging();
  bench.leg = LegMotion(options, kPeriod);
  bench.leg.plant(bench.time - 5.0, bench.p);
  bench.leg.lift(bench.time, {bench.p, bench.p + Vec3(0.2, 0.0, 0.0), kUp, kDuration, 0.08});
  EXPECT_EQ(bench.follow(kDuration + 0.05, 0.0), LegEvent::none);
  return bench;
}

TEST(LegMotion, AFastSearchHasNoContactWhileTheFootFallsAsAsked) {
  Bench bench = searching_fast();
  EXPECT_EQ(bench.follow(0.03, 50.0, 0.01 * kUp), LegEvent::none) << "what moves the foot";
  bench.foot_velocity = -0.1 * kUp;
  EXPECT_EQ(bench.follow(2.0 * kPeriod, 50.0), LegEvent::touchdown);
}

TEST(LegMotion, AFootOfAFastSearchHasTouchedWhereItBouncesUp) {
  const double risen = 1.5 * TouchdownOptions{}.bounce_force;
  Bench bench = searching_fast(), rises = searching_fast();
  bench.foot_velocity = rises.foot_velocity = 0.2 * kUp;
  EXPECT_EQ(bench.follow(kPeriod, risen), LegEvent::none);
  EXPECT_EQ(bench.follow(kPeriod, 0.0), LegEvent::touchdown) << "it has left the ground again";
  EXPECT_EQ(rises.follow(2.0 * kPeriod, 0.0), LegEvent::none) << "nothing pushed it";
}

TEST(LegMotion, ALostFootSearchesStraightDownFromWhereItIs) {
  Bench bench;
  bench.leg.plant(bench.time, bench.p, true);
  bench.observe(50.0);
  bench.leg.search(bench.time, bench.p, Vec3::Zero(), kUp);
  EXPECT_EQ(bench.leg.phase(), LegPhase::search);
  EXPECT_FALSE(bench.leg.down());
  const Vec3 start = bench.p;
  EXPECT_EQ(bench.follow(0.5, 0.0), LegEvent::none);
  const double gets_going = 0.02;  // half the time that it takes to
  const Vec3 way = -(0.5 - gets_going) * SwingOptions{}.touchdown_speed * kUp;
  EXPECT_LT((bench.p - (start + way)).norm(), 1e-9);
  EXPECT_EQ(bench.follow(kPeriod, 50.0), LegEvent::touchdown);
}

TEST(LegMotion, ASearchTakesAMovingFootOverAndBrakesItEvenly) {
  const Vec3 down = -SwingOptions{}.touchdown_speed * kUp;
  for (const Vec3& v : {Vec3(0.0, 0.0, 0.0), Vec3(1.2, -0.5, -0.4), Vec3(0.0, 0.0, 0.5)}) {
    Bench bench;
    bench.leg.plant(bench.time, bench.p, true);
    bench.observe(50.0);
    bench.leg.search(bench.time, bench.p, v, kUp);
    const FootPlan first = bench.leg.plan(bench.time);
    EXPECT_LT((first.v_WF - v).norm(), 1e-12);
    EXPECT_LT((first.p_WF - bench.p).norm(), 1e-12);
    double largest = 0.0;
    const double brakes = std::max(0.04, 1.5 * (v - down).norm() / 30.0);
    for (double t = 0.0; t < brakes; t += 0.1 * kPeriod) {
      largest = std::max(largest, bench.leg.plan(bench.time + t).a_WF.norm());
    }
    EXPECT_LT(largest, 30.0 + 1e-9) << v.transpose();
    const FootPlan after = bench.leg.plan(bench.time + brakes + kPeriod);
    EXPECT_LT((after.v_WF - down).norm(), 1e-12);
    EXPECT_EQ(after.a_WF.norm(), 0.0);
  }
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

TEST(LegMotion, AFootThatFliesOffDownwardShortlyAfterItCameDownIsNoticedAtOnce) {
  for (const bool at_once : {true, false}) {
    const Bench bench = landed(at_once);
    const Vec3 aside = Vec3::UnitX(), off = aside - kUp;
    EXPECT_EQ(moves(bench, 0.016 * off, 0.5 * off), LegEvent::airborne) << "off an edge";
    EXPECT_EQ(moves(bench, -0.021 * kUp, -0.7 * kUp), LegEvent::airborne) << "there was no ground";
    EXPECT_EQ(moves(bench, 0.016 * off, 0.4 * off), LegEvent::none) << "slowly";
    EXPECT_EQ(moves(bench, 0.013 * off, 0.5 * off), LegEvent::none) << "not yet far";
    Bench later = bench;
    EXPECT_EQ(later.rest(0.1, 50.0), LegEvent::none);
    EXPECT_EQ(moves(later, -0.03 * kUp, -1.0 * kUp), LegEvent::none);
  }
}

TEST(LegMotion, AFootPutDownAtOnceThatReboundsOrGoesAsideFliesTooButOthersBounce) {
  const Bench at_once = landed(true), in_time = landed(false);
  const Vec3 aside = Vec3::UnitX();
  EXPECT_EQ(moves(at_once, 0.006 * kUp, 0.3 * kUp), LegEvent::airborne);
  EXPECT_EQ(moves(at_once, 0.006 * kUp, 0.2 * kUp), LegEvent::none) << "its ground gives way";
  EXPECT_EQ(moves(at_once, 0.004 * kUp, 0.3 * kUp), LegEvent::none) << "the estimate is unsure";
  EXPECT_EQ(moves(at_once, -0.006 * kUp, -0.3 * kUp), LegEvent::none) << "it sinks in";
  EXPECT_EQ(moves(at_once, 0.021 * aside, 0.7 * aside), LegEvent::airborne);
  EXPECT_EQ(moves(at_once, 0.021 * aside, 0.5 * aside), LegEvent::none) << "it slides";
  EXPECT_EQ(moves(at_once, 0.019 * aside, 0.7 * aside), LegEvent::none);
  EXPECT_EQ(moves(in_time, 0.03 * kUp, 1.0 * kUp), LegEvent::none);
  EXPECT_EQ(moves(in_time, 0.03 * aside, 1.0 * aside), LegEvent::none);
}

TEST(LegMotion, AFootPutDownFastOnlyBouncesUnlessItGoesDeeper) {
  PlannerOptions options;
  options.swing = test::kSwing;
  options.swing.search_speed = 1.0;
  Bench fast = landed(true);
  fast.leg.use(options, fast.time);
  EXPECT_EQ(moves(fast, 0.03 * kUp, 1.0 * kUp), LegEvent::none);
  EXPECT_EQ(moves(fast, -0.021 * kUp, -0.7 * kUp), LegEvent::airborne) << "there was no ground";
}

TEST(LegMotion, WhereAFootThatFlewStoodBeforeIsItsFootholdAgain) {
  Bench bench = landed(false);
  const Vec3 came_down = bench.leg.foothold();
  bench.p -= 0.03 * kUp;
  bench.foot_velocity = -kUp;
  ASSERT_EQ(bench.rest(kPeriod, 50.0), LegEvent::airborne);
  EXPECT_GT((bench.leg.foothold() - came_down).norm(), 0.1);
  EXPECT_EQ(bench.leg.foothold(), Bench{}.p);
}

}  // namespace
}  // namespace surefoot::gaits
