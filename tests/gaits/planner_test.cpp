// The walk on level ground.
#include "surefoot/base/error.hpp"
#include "tests/gaits/watch.hpp"
#include "tests/support/event_kinds.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::gaits {
namespace {

TEST(Planner, StandsStillUntilItIsToldToWalk) {
  test::Puppet puppet;
  test::run_watched(puppet, 3.0);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  EXPECT_TRUE(puppet.happenings().empty());
  EXPECT_LT(puppet.plan().com.p.norm(), 1e-6);
  EXPECT_LT(puppet.plan().com.v.norm(), 1e-6);
  EXPECT_EQ(puppet.plan().time, puppet.time());
  EXPECT_EQ(puppet.planner().terrain_normal(), Vec3::UnitZ());
}

Vec2 center_of_feet(const test::Puppet& puppet) {
  Vec2 center = Vec2::Zero();
  for (const Leg leg : kLegs) center += 0.25 * puppet.foot(leg).head<2>();
  return center;
}

TEST(Planner, WalksAsFastAsItIsTold) {
  // Each touchdown is noticed a little late; steps into footprints are taken as they come.
  for (const auto& [prints, tolerance] : {std::pair(false, 0.02), std::pair(true, 0.10)}) {
    for (const double velocity : {-0.05, 0.03, 0.06}) {
      SCOPED_TRACE(std::to_string(velocity) + (prints ? " m/s in prints" : " m/s"));
      PlannerOptions options;
      options.foothold.hind_use_front_prints = prints;
      test::Puppet puppet(options);
      puppet.user = test::walking(velocity);
      test::run_watched(puppet, 10.0);
      const double begin = puppet.com().x();
      test::run_watched(puppet, 38.0);  // ten cycles
      EXPECT_NEAR((puppet.com().x() - begin) / 38.0, velocity, tolerance * std::abs(velocity));
      EXPECT_NEAR(center_of_feet(puppet).y(), 0.0, 0.01);
      EXPECT_EQ(puppet.planner().steps_taken(),
                static_cast<int>(puppet.happenings(PlanEvent::touchdown).size()));
      EXPECT_NEAR(puppet.planner().steps_taken(), 47.0 / 3.8 * 4.0, 2.0);
    }
  }
}

TEST(Planner, StandsNoHigherThanItsLegsReachAndSaysSo) {
  test::Puppet puppet;
  puppet.user = {.height = 0.3};
  puppet.run(4.0);
  const double standing = puppet.plan().torso.height;
  EXPECT_LT(standing, SwingOptions{}.reach_max);
  EXPECT_GT(standing, StanceOptions{}.height + 0.02);
  EXPECT_EQ(puppet.happenings(PlanEvent::lowered).size(), 1u);
  puppet.user.walk = true;
  puppet.user.velocity.x() = 0.06;
  puppet.run(12.0);
  EXPECT_LT(puppet.plan().torso.height, standing - 0.01) << "strides take of it";
  EXPECT_GE(puppet.plan().torso.height, StanceOptions{}.height - 1e-9);
  puppet.user = {.height = -0.1};
  puppet.run(8.0);
  EXPECT_NEAR(puppet.plan().torso.height, StanceOptions{}.height - 0.1, 1e-3);
  EXPECT_EQ(puppet.happenings(PlanEvent::lowered).size(), 1u);
  puppet.user = {.height = 0.3};
  puppet.run(1.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::lowered).size(), 2u) << "asked for once more";
}

// A torso any lower leaves the legs no room to step.
TEST(Planner, WalksNoLowerThanItsLegsCanStepAndSaysSo) {
  test::Puppet puppet = test::walker();
  puppet.run(4.0);
  puppet.user.height = -0.25;
  puppet.run(6.0, [&] { EXPECT_LT(std::abs(puppet.plan().torso.height_rate), 0.16); });
  EXPECT_NEAR(puppet.plan().torso.height, StanceOptions{}.height - 0.10, 2e-3);
  EXPECT_EQ(puppet.happenings(PlanEvent::raised).size(), 1u);
  puppet.user.walk = false;
  puppet.run(4.0);
  EXPECT_NEAR(puppet.plan().torso.height, StanceOptions{}.height - 0.25, 2e-3);
}

// What was planned at a touchdown, the COM's way and the foothold behind it, is walked as planned.
TEST(Planner, AVelocityThatChangesIsTakenUpFromTheNextStepOnAndStepByStep) {
  for (const double at : {4.0, 4.3, 4.6, 4.9}) {
    test::Puppet same = test::walker(), turned = test::walker();
    for (test::Puppet* puppet : {&same, &turned}) puppet->run(at);
    turned.user = test::walking(-0.2, -0.1);
    const auto touchdowns = [](const test::Puppet& puppet) {
      return puppet.happenings(PlanEvent::touchdown).size();
    };
    const std::size_t before = touchdowns(turned);
    const bool swings = turned.plan().num_contacts() < 4;
    while (touchdowns(turned) == before) {
      for (test::Puppet* puppet : {&same, &turned}) puppet->tick();
      if (touchdowns(turned) > before) break;
      for (const Leg leg : kLegs) EXPECT_EQ(turned.foot(leg), same.foot(leg)) << at;
      EXPECT_EQ(turned.com(), same.com()) << at;
    }
    const double taken_up = swings ? 0.0 : 0.1;
    EXPECT_LT((turned.plan().com.v - same.plan().com.v).norm(), taken_up + 0.1) << at;
    turned.run(20.0);
    const Vec2 begin = turned.com();
    turned.run(3.8);
    const Vec2 velocity = (turned.com() - begin) / 3.8;
    EXPECT_LT(velocity.x(), -0.05) << at;
    EXPECT_LT(velocity.y(), -0.02) << at;
  }
}

TEST(Planner, WhereStridesWouldBeTooLongItComesToWalkAsIfToldSoFromTheStart) {
  for (const Vec2& velocity : {Vec2(1.0, 0.1), Vec2(0.05, 0.5), Vec2(0.3, 0.2)}) {
    test::Puppet first, later = test::walker();
    first.user = test::walking(velocity.x(), velocity.y());
    later.run(5.0);
    later.user = first.user;
    const auto way = [](test::Puppet& puppet) -> Vec2 {
      puppet.run(20.0);
      const Vec2 begin = puppet.com();
      puppet.run(11.4);  // three cycles
      return puppet.com() - begin;
    };
    const Vec2 expected = way(first);
    EXPECT_LT((way(later) - expected).norm(), 0.03 * expected.norm()) << velocity.transpose();
  }
}

TEST(Planner, AnOrderThatLeavesALegOutIsRefused) {
  PlannerOptions options;
  options.gait.order = {Leg::LH, Leg::LF, Leg::RH, Leg::LF};
  EXPECT_THROW(test::Puppet{options}, Error);
}

TEST(Planner, LiftsItsFeetInTheOrderOfTheGaitBackwardWithForeAndHindExchanged) {
  for (const PerLeg<Leg>& order : {GaitOptions{}.order, {Leg::RF, Leg::LH, Leg::LF, Leg::RH}}) {
    for (const double velocity : {0.06, -0.06}) {
      PlannerOptions options;
      options.gait.order = order;
      test::Puppet puppet(options);
      puppet.user = test::walking(velocity);
      puppet.run(16.0);
      const std::vector<test::Happening> lifts = puppet.happenings(PlanEvent::lift_off);
      ASSERT_GT(lifts.size(), velocity > 0.0 ? 12u : 4u);
      for (std::size_t i = 0; i < lifts.size(); ++i) {
        const Leg next = order[i % order.size()];
        EXPECT_EQ(lifts[i].leg, velocity > 0.0 ? next : same_side(next)) << i;
      }
    }
  }
}

/// The longest way from a leg's hip to its foothold at the landing, in a walk as fast as it goes. A
/// puppet's hips are over their feet; in a swing they go with the centre of mass.
double longest_reach(const PlannerOptions& options) {
  test::Puppet puppet(options);
  puppet.user = test::walking(5.0);
  double longest = 0.0;
  PerLeg<bool> swung{};
  PerLeg<Vec2> stood{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  puppet.run(25.0, [&] {
    for (const Leg k : kLegs) {
      const std::size_t i = index(k);
      const bool stands = puppet.plan().contact(k);
      const Vec2 from_com = puppet.foot(k).head<2>() - puppet.com();
      if (stands && swung[i]) longest = std::max(longest, (from_com - stood[i]).norm());
      if (stands) stood[i] = from_com;
      swung[i] = !stands;
    }
  });
  return longest;
}

/// Along the ground, with the hip at a height over it.
double reach_along(const PlannerOptions& options, double height) {
  return std::sqrt(std::pow(options.swing.reach_max, 2) - height * height);
}

TEST(Planner, NoFootholdIsFurtherFromItsHipThanItsLegReaches) {
  PlannerOptions options;
  options.stance.height = 0.29;
  options.swing.reach_max = 0.34;
  const double reach = reach_along(options, options.stance.height);
  const double longest = longest_reach(options);
  EXPECT_LT(longest, reach + 0.01) << "where the hip is then is known to some millimetres";
  EXPECT_GT(longest, reach - 0.01);
}

// A puppet's hips are at 0.3 m: too high, as over ground that is lower.
TEST(Planner, AHipThatWillComeDownShortensNoFoothold) {
  PlannerOptions options;
  options.stance.height = 0.25;
  options.swing.reach_max = 0.33;
  const double longest = longest_reach(options);
  EXPECT_GT(longest, reach_along(options, 0.3) + 0.04);
  EXPECT_LT(longest, reach_along(options, options.stance.height) + 0.01);
}

TEST(Planner, WalksSlowerThanCommandedWhereStridesWouldBeTooLong) {
  test::Puppet puppet = test::walker();
  puppet.user = test::walking(5.0);
  puppet.run(16.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::slowed).size(), 1u);
  EXPECT_GT(puppet.happenings(PlanEvent::lift_off).size(), 12u);
  EXPECT_EQ(puppet.happenings(PlanEvent::lift_off_aborted).size(), 0u);
}

/// Of a turn on the spot, of what is commanded, after its first steps.
double turned_share(test::Puppet& puppet, double yaw_rate) {
  puppet.user = test::walking(0.0);
  puppet.user.yaw_rate = yaw_rate;
  puppet.run(12.0);
  double turned = 0.0;
  puppet.run(20.0, [&] { turned += test::Puppet::kPeriod * puppet.plan().torso.w_WB.z(); });
  return turned / (20.0 * yaw_rate);
}

TEST(Planner, SaysWhereItTurnsSlowerThanCommanded) {
  for (const double yaw_rate : {0.06, 0.11, -0.11}) {
    test::Puppet puppet = test::walker();
    EXPECT_NEAR(turned_share(puppet, yaw_rate), 1.0, 0.02) << yaw_rate;
    EXPECT_TRUE(puppet.happenings(PlanEvent::slowed).empty()) << yaw_rate;
  }
  for (const double yaw_rate : {0.15, -0.15, 0.5}) {
    test::Puppet puppet = test::walker();
    EXPECT_LT(turned_share(puppet, yaw_rate), 0.98) << yaw_rate;
    EXPECT_EQ(puppet.happenings(PlanEvent::slowed).size(), 1u) << yaw_rate;
  }
}

TEST(Planner, SaysThatItWalksSlowerAlsoWhereAFootComesDownAtThatTick) {
  test::Puppet puppet = test::walker();
  const auto comes_down = [&] { return puppet.plan().events.has(PlanEvent::touchdown); };
  test::Puppet other = test::walker();
  int ticks = 0;
  for (; !comes_down(); ++ticks) puppet.tick();
  for (int i = 0; i + 1 < ticks; ++i) other.tick();
  other.user = test::walking(5.0);
  other.tick();
  EXPECT_EQ(test::kinds_of(other.plan().events),
            (std::vector{PlanEvent::touchdown, PlanEvent::slowed}));
}

TEST(Planner, TheZmpNeverHasToLeaveTheSupportOfAWalkOnLevelGround) {
  test::Puppet puppet = test::walker();
  double slack = 0.0;
  puppet.run(20.0, [&] { slack = std::max(slack, puppet.plan().com_zmp_slack); });
  EXPECT_LT(slack, 1e-3);
}

TEST(Planner, LiftsAFootOnlyWhenItCarriesNothing) {
  test::Puppet puppet = test::walker();
  PerLeg<double> before{};
  std::size_t seen = 0;
  puppet.run(12.0, [&] {
    const std::vector<test::Happening> lifts = puppet.happenings(PlanEvent::lift_off);
    for (; seen < lifts.size(); ++seen) EXPECT_LT(before[index(lifts[seen].leg)], 15.0);
    for (const Leg leg : kLegs) before[index(leg)] = puppet.plan().feet[index(leg)].force_max;
  });
  EXPECT_GT(seen, 8u);
}

TEST(Planner, ASwingFootFollowsTheCommandedSteps) {
  PlannerOptions options;
  options.foothold.hind_use_front_prints = false;
  test::Puppet puppet = test::walker(options);
  puppet.run(40.0);
  const std::vector<test::Happening> lifts = puppet.happenings(PlanEvent::lift_off);
  const std::vector<test::Happening> landings = puppet.happenings(PlanEvent::touchdown);
  const double stride = 0.06 * 3.8;
  ASSERT_GE(landings.size(), 8u);
  ASSERT_GE(lifts.size(), landings.size());
  for (std::size_t i = landings.size() - 8; i < landings.size(); ++i) {
    ASSERT_EQ(landings[i].leg, lifts[i].leg);
    EXPECT_NEAR(landings[i].p.x() - lifts[i].p.x(), stride, 0.01 * stride);
    EXPECT_NEAR(landings[i].p.y() - lifts[i].p.y(), 0.0, 1e-3);
  }
}

TEST(Planner, WalksSidewaysAndTurns) {
  test::Puppet sideways;
  sideways.user = test::walking(0.0, 0.03);
  test::run_watched(sideways, 30.0);
  EXPECT_NEAR(sideways.com().y(), 0.03 * 29.0, 0.1);
  EXPECT_NEAR(center_of_feet(sideways).x(), 0.0, 0.05);
  test::Puppet turning;
  turning.user = test::walking(0.0, 0.0, 0.05);
  test::run_watched(turning, 20.0);
  EXPECT_NEAR(yaw(turning.plan().torso.q_WB.toRotationMatrix()), 0.05 * 20.0, 0.01);
  EXPECT_NEAR(yaw(turning.plan().R_WC), 0.05 * 20.0, 0.01);
  const Vec3 across = turning.foot(Leg::LF) - turning.foot(Leg::RF);
  EXPECT_NEAR(std::atan2(-across.x(), across.y()), 0.05 * 20.0, 0.15) << "the feet came along";
}

TEST(Planner, StopsOverAllFourFeetWheneverItIsTold) {
  for (const double when : {1.2, 1.6, 2.3, 4.1, 5.55}) {
    SCOPED_TRACE("stopped after " + std::to_string(when) + " s");
    test::Puppet puppet = test::walker();
    test::run_watched(puppet, when);
    test::stop(puppet);
    EXPECT_EQ(puppet.plan().num_contacts(), 4);
    for (const FootPlan& foot : puppet.plan().feet) EXPECT_EQ(foot.phase, LegPhase::stance);
    EXPECT_LT((puppet.plan().com.p - center_of_feet(puppet)).norm(), 1e-3);
    EXPECT_LT(puppet.plan().com.v.norm(), 1e-4);
    puppet.user.walk = true;
    const int steps = puppet.planner().steps_taken();
    test::run_watched(puppet, 5.0);
    EXPECT_GT(puppet.planner().steps_taken(), steps) << "and walks on";
  }
}

TEST(Planner, PlansTheSameWhereverTheWorldsOriginLies) {
  test::RandomMatrices random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const double angle = random.uniform(-3.0, 3.0);
    const Mat3 R = rotation_about_z(angle);
    const Vec3 shift(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0),
                     random.uniform(-5.0, 5.0));
    // Bumps that the feet meet early and late.
    const test::Ground bumpy = [](const Vec2& p) {
      return 0.01 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y());
    };
    const test::Ground moved = [&](const Vec2& p) {
      const Vec3 back = R.transpose() * (Vec3(p.x(), p.y(), 0.0) - shift);
      return bumpy(back.head<2>()) + shift.z();
    };
    PlannerOptions options;
    options.contact.stall_error = 3.1e-3;  // no whole number of the search's steps
    test::Puppet here(options, bumpy), there(options, moved, shift.head<2>(), angle);
    here.user = there.user = test::walking(0.06, 0.01, 0.02);
    here.run(12.0, [&] {
      there.tick();
      const MotionPlan &a = here.plan(), &b = there.plan();
      EXPECT_EQ(test::kinds_of(a.events), test::kinds_of(b.events)) << here.time();
      EXPECT_LT((R.topLeftCorner<2, 2>() * a.com.p + shift.head<2>() - b.com.p).norm(), 1e-5);
      EXPECT_NEAR(a.torso.height + shift.z(), b.torso.height, 1e-6);
      EXPECT_LT(box_minus(Quat(R) * a.torso.q_WB, b.torso.q_WB).norm(), 1e-6);
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        EXPECT_EQ(a.feet[k].phase, b.feet[k].phase);
        EXPECT_LT((R * a.feet[k].p_WF + shift - b.feet[k].p_WF).norm(), 1e-5);
      }
    });
    EXPECT_GT(here.planner().steps_taken(), 8);
  }
}

}  // namespace
}  // namespace surefoot::gaits
