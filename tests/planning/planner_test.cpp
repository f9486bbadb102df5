#include "surefoot/planning/planner.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/planning/puppet.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surefoot {
namespace {

using test::Ground;
using test::Happening;
using test::level_ground;
using test::Puppet;
using test::RandomMatrices;
using test::step_at;

constexpr double kPeriod = Puppet::kPeriod;

UserCommand walking(double forward = 0.06, double lateral = 0.0, double yaw_rate = 0.0) {
  return {.walk = true, .velocity = {forward, lateral}, .yaw_rate = yaw_rate};
}

Puppet walker(const PlannerOptions& options = {}, Ground ground = level_ground()) {
  Puppet puppet(options, std::move(ground));
  puppet.user = walking();
  return puppet;
}

bool all_finite(const MotionPlan& plan) {
  bool finite = plan.com.p.allFinite() && plan.com.v.allFinite() && plan.com.a.allFinite() &&
                plan.torso.q_WB.coeffs().allFinite() && plan.torso.w_WB.allFinite() &&
                std::isfinite(plan.torso.height) && std::isfinite(plan.com_zmp_slack);
  for (const FootPlan& foot : plan.feet) {
    finite = finite && foot.p_WF.allFinite() && foot.v_WF.allFinite() && foot.a_WF.allFinite() &&
             std::isfinite(foot.force_min) && std::isfinite(foot.force_max);
  }
  return finite;
}

/// Holds a plan against the one of the tick before: what must hold whatever the ground is like.
class Watch {
 public:
  explicit Watch(const Puppet& puppet) : puppet_(puppet), before_(puppet.plan()) {}

  void operator()() {
    const MotionPlan& now = puppet_.plan();
    ASSERT_TRUE(all_finite(now)) << puppet_.time();
    ASSERT_GE(now.num_contacts(), 3) << puppet_.time();
    ASSERT_LT((now.com.p - before_.com.p).norm(), 0.5 * kPeriod) << puppet_.time();
    ASSERT_LT((now.com.v - before_.com.v).norm(), 3.0 * kPeriod) << puppet_.time();
    ASSERT_LT((now.com.a - before_.com.a).norm(), 0.15) << puppet_.time();
    ASSERT_LT(box_minus(now.torso.q_WB, before_.torso.q_WB).norm(), 2.0 * kPeriod);
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      const FootPlan &foot = now.feet[k], &last = before_.feet[k];
      ASSERT_LT((foot.p_WF - last.p_WF).norm(), 8e-3) << k << " at " << puppet_.time();
      ASSERT_LT(std::abs(foot.force_max - last.force_max), 10.0) << k << " at " << puppet_.time();
      ASSERT_LE(foot.force_min, foot.force_max);
      ASSERT_EQ(in_contact(foot.phase) ? 0.0 : foot.force_max, 0.0);
    }
    before_ = now;
  }

 private:
  const Puppet& puppet_;
  MotionPlan before_;
};

/// Walks on under a watch.
void run_watched(Puppet& puppet, double duration) {
  Watch watch(puppet);
  const double end = puppet.time() + duration;
  while (puppet.time() < end && !testing::Test::HasFatalFailure()) {
    puppet.tick();
    watch();
  }
}

TEST(Planner, StandsStillUntilItIsToldToWalk) {
  Puppet puppet;
  run_watched(puppet, 3.0);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  EXPECT_TRUE(puppet.happenings().empty());
  EXPECT_LT(puppet.plan().com.p.norm(), 1e-6);
  EXPECT_LT(puppet.plan().com.v.norm(), 1e-6);
  EXPECT_EQ(puppet.plan().time, puppet.time());
  EXPECT_EQ(puppet.planner().terrain_normal(), Vec3::UnitZ());
}

Vec2 center_of_feet(const Puppet& puppet) {
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
      Puppet puppet(options);
      puppet.user = walking(velocity);
      run_watched(puppet, 10.0);
      const double begin = puppet.com().x();
      run_watched(puppet, 38.0);  // ten cycles
      EXPECT_NEAR((puppet.com().x() - begin) / 38.0, velocity, tolerance * std::abs(velocity));
      EXPECT_NEAR(center_of_feet(puppet).y(), 0.0, 0.01);
      EXPECT_EQ(puppet.planner().steps_taken(),
                static_cast<int>(puppet.happenings(PlanEvent::touchdown).size()));
      EXPECT_NEAR(puppet.planner().steps_taken(), 47.0 / 3.8 * 4.0, 2.0);
    }
  }
}

TEST(Planner, LiftsItsFeetInTheOrderOfTheGait) {
  for (const PerLeg<Leg>& order : {PerLeg<Leg>{Leg::LH, Leg::LF, Leg::RH, Leg::RF},
                                   PerLeg<Leg>{Leg::RF, Leg::LH, Leg::LF, Leg::RH}}) {
    PlannerOptions options;
    options.gait.order = order;
    Puppet puppet = walker(options);
    puppet.run(16.0);
    const std::vector<Happening> lifts = puppet.happenings(PlanEvent::lift_off);
    ASSERT_GT(lifts.size(), 12u);
    for (std::size_t i = 0; i < lifts.size(); ++i) {
      EXPECT_EQ(lifts[i].leg, order[i % order.size()]) << i;
    }
  }
}

TEST(Planner, WalksBackwardWithForeAndHindExchanged) {
  Puppet puppet = walker();
  puppet.user = walking(-0.06);
  puppet.run(16.0);
  const std::vector<Happening> lifts = puppet.happenings(PlanEvent::lift_off);
  const PerLeg<Leg> order = GaitOptions{}.order;
  ASSERT_GT(lifts.size(), 4u);
  for (std::size_t i = 0; i < lifts.size(); ++i) {
    EXPECT_EQ(lifts[i].leg, same_side(order[i % order.size()])) << i;
  }
}

TEST(Planner, WalksSlowerThanCommandedWhereStridesWouldBeTooLong) {
  Puppet puppet = walker();
  puppet.user = walking(5.0);
  puppet.run(16.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::slowed).size(), 1u);
  EXPECT_GT(puppet.happenings(PlanEvent::lift_off).size(), 12u);
  EXPECT_EQ(puppet.happenings(PlanEvent::lift_off_aborted).size(), 0u);
}

TEST(Planner, TheZmpNeverHasToLeaveTheSupportOfAWalkOnLevelGround) {
  Puppet puppet = walker();
  double slack = 0.0;
  puppet.run(20.0, [&] { slack = std::max(slack, puppet.plan().com_zmp_slack); });
  EXPECT_LT(slack, 1e-3);
}

TEST(Planner, LiftsAFootOnlyWhenItCarriesNothing) {
  Puppet puppet = walker();
  PerLeg<double> before{};
  std::size_t seen = 0;
  puppet.run(12.0, [&] {
    const std::vector<Happening> lifts = puppet.happenings(PlanEvent::lift_off);
    for (; seen < lifts.size(); ++seen) EXPECT_LT(before[index(lifts[seen].leg)], 15.0);
    for (const Leg leg : kLegs) before[index(leg)] = puppet.plan().feet[index(leg)].force_max;
  });
  EXPECT_GT(seen, 8u);
}

TEST(Planner, ASwingFootFollowsTheCommandedSteps) {
  PlannerOptions options;
  options.foothold.hind_use_front_prints = false;
  Puppet puppet = walker(options);
  puppet.run(40.0);
  const std::vector<Happening> lifts = puppet.happenings(PlanEvent::lift_off);
  const std::vector<Happening> landings = puppet.happenings(PlanEvent::touchdown);
  const double stride = 0.06 * 3.8;
  for (std::size_t i = landings.size() - 8; i < landings.size(); ++i) {
    ASSERT_EQ(landings[i].leg, lifts[i].leg);
    EXPECT_NEAR(landings[i].p.x() - lifts[i].p.x(), stride, 0.01 * stride);
    EXPECT_NEAR(landings[i].p.y() - lifts[i].p.y(), 0.0, 1e-3);
  }
}

TEST(Planner, WalksSidewaysAndTurns) {
  Puppet sideways;
  sideways.user = walking(0.0, 0.03);
  run_watched(sideways, 30.0);
  EXPECT_NEAR(sideways.com().y(), 0.03 * 29.0, 0.1);
  EXPECT_NEAR(center_of_feet(sideways).x(), 0.0, 0.05);
  Puppet turning;
  turning.user = walking(0.0, 0.0, 0.05);
  run_watched(turning, 20.0);
  EXPECT_NEAR(yaw(turning.plan().torso.q_WB.toRotationMatrix()), 0.05 * 20.0, 0.01);
  EXPECT_NEAR(yaw(turning.plan().R_WC), 0.05 * 20.0, 0.01);
  const Vec3 across = turning.foot(Leg::LF) - turning.foot(Leg::RF);
  EXPECT_NEAR(std::atan2(-across.x(), across.y()), 0.05 * 20.0, 0.15) << "the feet came along";
}

/// Lets the puppet finish its step and stand.
void stop(Puppet& puppet) {
  puppet.user.walk = false;
  run_watched(puppet, 4.0);
}

TEST(Planner, StopsOverAllFourFeetWheneverItIsTold) {
  for (const double when : {1.2, 1.6, 2.3, 4.1, 5.55}) {
    SCOPED_TRACE("stopped after " + std::to_string(when) + " s");
    Puppet puppet = walker();
    run_watched(puppet, when);
    stop(puppet);
    EXPECT_EQ(puppet.plan().num_contacts(), 4);
    for (const FootPlan& foot : puppet.plan().feet) EXPECT_EQ(foot.phase, LegPhase::stance);
    EXPECT_LT((puppet.plan().com.p - center_of_feet(puppet)).norm(), 1e-3);
    EXPECT_LT(puppet.plan().com.v.norm(), 1e-4);
    puppet.user.walk = true;
    const int steps = puppet.planner().steps_taken();
    run_watched(puppet, 5.0);
    EXPECT_GT(puppet.planner().steps_taken(), steps) << "and walks on";
  }
}

TEST(Planner, PlansTheSameWhereverTheWorldsOriginLies) {
  RandomMatrices random(1);
  for (int trial = 0; trial < 3; ++trial) {
    const double angle = random.uniform(-3.0, 3.0);
    const Mat3 R = rotation_about_z(angle);
    const Vec3 shift(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0),
                     random.uniform(-5.0, 5.0));
    // Bumps that the feet meet early and late.
    const Ground bumpy = [](const Vec2& p) {
      return 0.01 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y());
    };
    const Ground moved = [&](const Vec2& p) {
      const Vec3 back = R.transpose() * (Vec3(p.x(), p.y(), 0.0) - shift);
      return bumpy(back.head<2>()) + shift.z();
    };
    Puppet here({}, bumpy), there({}, moved, shift.head<2>(), angle);
    here.user = there.user = walking(0.06, 0.01, 0.02);
    here.run(12.0, [&] {
      there.tick();
      const MotionPlan &a = here.plan(), &b = there.plan();
      EXPECT_EQ(a.event, b.event) << here.time();
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

TEST(Planner, WaitsWhileAFootLooksForGroundThatLiesLower) {
  Puppet puppet = walker({}, step_at(0.40, -0.10));
  run_watched(puppet, 40.0);
  const std::vector<Happening> late = puppet.happenings(PlanEvent::late);
  ASSERT_GE(late.size(), 2u);
  for (const Happening& wait : late) {
    const auto next = std::ranges::find_if(puppet.happenings(), [&](const Happening& h) {
      return h.time > wait.time && h.event != PlanEvent::late;
    });
    ASSERT_NE(next, puppet.happenings().end());
    EXPECT_EQ(next->event, PlanEvent::touchdown) << "nothing else happens meanwhile";
    EXPECT_NEAR(next->p.z(), -0.10, 2e-3);
  }
  stop(puppet);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), -0.10, 2e-3) << "all went down";
  EXPECT_NEAR(puppet.plan().torso.height, -0.10 + StanceOptions{}.height, 2e-3);
}

TEST(Planner, StaysOverTheOtherFeetWhileItWaits) {
  PlannerOptions options;
  options.swing.search_depth_max = 2.0;  // a search of 20 s
  Puppet puppet = walker(options, step_at(0.40, -1.5));
  run_watched(puppet, 12.0);
  ASSERT_GT(puppet.happenings(PlanEvent::late).size(), 5u);
  EXPECT_EQ(puppet.happenings().back().event, PlanEvent::late) << "it still waits";
  EXPECT_LT(puppet.plan().com.v.norm(), 0.05) << "it sways by some millimetres";
  PerLeg<Vec2> feet;
  PerLeg<double> share{1.0, 1.0, 1.0, 1.0};
  for (const Leg leg : kLegs) {
    feet[index(leg)] = puppet.foot(leg).head<2>();
    share[index(leg)] = puppet.plan().contact(leg) ? 1.0 : 0.0;
  }
  EXPECT_GT(SupportRegion(feet, share).margin(puppet.plan().com.p), 0.02);
}

TEST(Planner, TakesAFootBackWhereThereIsNoGround) {
  const double edge = 0.45;
  Puppet puppet = walker({}, step_at(edge, test::kNoGround));
  run_watched(puppet, 60.0);
  const std::vector<Happening> back = puppet.happenings(PlanEvent::no_ground);
  ASSERT_GE(back.size(), 2u);
  for (const Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
    EXPECT_LE(landing.p.x(), edge);
    EXPECT_NEAR(landing.p.z(), 0.0, 1e-3);
  }
  const auto landed = std::ranges::find_if(puppet.happenings(), [&](const Happening& h) {
    return h.time > back.front().time && h.event == PlanEvent::touchdown;
  });
  ASSERT_NE(landed, puppet.happenings().end());
  EXPECT_EQ(landed->leg, back.front().leg) << "the foot that was taken back stands again";
}

TEST(Planner, GroundThatLiesHigherIsMetEarly) {
  Puppet puppet = walker({}, step_at(0.40, 0.05));
  run_watched(puppet, 40.0);
  stop(puppet);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), 0.05, 2e-3) << "all went up";
  EXPECT_NEAR(puppet.plan().torso.height, 0.05 + StanceOptions{}.height, 2e-3);
}

TEST(Planner, OnlyAHindFootThatKnowsTheGroundRefusesOneThatLiesHigher) {
  PlannerOptions options;
  options.foothold.hind_use_front_prints = false;
  Puppet puppet = walker(options, step_at(0.40, 0.08));
  puppet.run(40.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::collision).empty());
  puppet.user.walk = false;
  puppet.run(4.0);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), 0.08, 2e-3) << "all went up";
}

TEST(Planner, LeansWithTheSlopeThatItsFeetFind) {
  const double slope = 0.15;
  const Ground ramp = [=](const Vec2& p) { return slope * std::max(0.0, p.x() - 0.5); };
  Puppet puppet = walker({}, ramp);
  run_watched(puppet, 60.0);
  const Vec3 normal = Vec3(-slope, 0.0, 1.0).normalized();
  EXPECT_LT((puppet.planner().terrain_normal() - normal).norm(), 0.01);
  EXPECT_LT((puppet.plan().torso.q_WB * Vec3::UnitZ() - normal).norm(), 0.01);
  EXPECT_LT((puppet.plan().R_WC.col(2) - normal).norm(), 0.01);
}

TEST(Planner, AStanceFootThatLosesItsGroundGoesDownForIt) {
  Puppet puppet;
  puppet.run(0.5);
  const double z = puppet.foot(Leg::RH).z();
  puppet.ground = [](const Vec2& p) { return p.x() < 0.0 && p.y() < 0.0 ? -0.05 : 0.0; };
  puppet.run(2.0);
  ASSERT_EQ(puppet.happenings(PlanEvent::lost_contact).size(), 1u);
  EXPECT_EQ(puppet.happenings(PlanEvent::lost_contact).front().leg, Leg::RH);
  ASSERT_EQ(puppet.happenings(PlanEvent::touchdown).size(), 1u);
  EXPECT_NEAR(puppet.foot(Leg::RH).z(), z - 0.05, 1e-3);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  puppet.user = walking();
  run_watched(puppet, 10.0);
  EXPECT_GT(puppet.planner().steps_taken(), 4);
}

TEST(Planner, AFootThatDoesNotUnloadIsNotLifted) {
  Puppet puppet = walker();
  puppet.sticky[index(Leg::LH)] = true;
  run_watched(puppet, 12.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off).empty());
  EXPECT_GE(puppet.happenings(PlanEvent::lift_off_aborted).size(), 2u);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  puppet.sticky = {};
  run_watched(puppet, 5.0);
  EXPECT_FALSE(puppet.happenings(PlanEvent::lift_off).empty()) << "and is when it does";
}

TEST(Planner, NoFootIsLiftedWhileTheBalanceIsNotOverTheOthers) {
  Puppet puppet = walker();
  puppet.com_follows = false;  // stays in the middle, which lies on the triangle's edge
  puppet.run(12.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off).empty());
  EXPECT_GE(puppet.happenings(PlanEvent::lift_off_aborted).size(), 2u);
}

PlannerOptions probing() {
  PlannerOptions options;
  options.probe.enabled = true;
  return options;
}

/// The happenings that follow a lift-off, up to the landing.
std::vector<PlanEvent> swing_from(const Puppet& puppet, const Happening& lift) {
  std::vector<PlanEvent> events;
  for (const Happening& h : puppet.happenings()) {
    const bool ended = !events.empty() && events.back() == PlanEvent::touchdown;
    if (h.time > lift.time && !ended) events.push_back(h.event);
  }
  return events;
}

TEST(Planner, AFrontFootTouchesTwiceWhereItProbesAndAHindFootOnce) {
  Puppet puppet = walker(probing());
  run_watched(puppet, 30.0);
  const std::vector<PlanEvent> once{PlanEvent::touchdown};
  const std::vector<PlanEvent> twice{PlanEvent::probe_same_ground, PlanEvent::touchdown};
  const std::vector<Happening> lifts = puppet.happenings(PlanEvent::lift_off);
  ASSERT_GT(lifts.size(), 12u);
  for (std::size_t i = 0; i + 1 < lifts.size(); ++i) {
    EXPECT_EQ(swing_from(puppet, lifts[i]), is_front(lifts[i].leg) ? twice : once);
  }
  const std::vector<Happening> probes = puppet.happenings(PlanEvent::probe_same_ground);
  const std::vector<Happening> landings = puppet.happenings(PlanEvent::touchdown);
  for (std::size_t i = 0; i + 1 < probes.size(); ++i) {
    const auto landing =
        std::ranges::find_if(landings, [&](const Happening& h) { return h.time > probes[i].time; });
    EXPECT_EQ(landing->leg, probes[i].leg);
    EXPECT_NEAR(probes[i].p.x() - landing->p.x(), ProbeOptions{}.ahead, 0.01);
  }
}

TEST(Planner, NoFootLandsOnAnEdgeThatItsProbesCanFind) {
  RandomMatrices random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const double edge = random.uniform(0.40, 0.62), height = random.uniform(-0.15, -0.05);
    SCOPED_TRACE("edge of " + std::to_string(height) + " m at " + std::to_string(edge));
    Puppet puppet = walker(probing(), step_at(edge, height));
    puppet.user = walking(0.03);
    run_watched(puppet, 60.0);
    EXPECT_GE(puppet.happenings(PlanEvent::probe_edge).size(), 1u);
    for (const Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
      EXPECT_GT(std::abs(landing.p.x() - edge), 0.03) << "at " << landing.time;
    }
    stop(puppet);
    for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), height, 2e-3);
  }
}

TEST(Planner, AnEdgeThatAProbeFindsIsLeftBehind) {
  Puppet puppet = walker(probing(), step_at(0.45, -0.10));
  puppet.user = walking(0.03);
  puppet.run(40.0);
  const std::vector<Happening> edges = puppet.happenings(PlanEvent::probe_edge);
  ASSERT_FALSE(edges.empty());
  const std::vector<Happening> landings = puppet.happenings(PlanEvent::touchdown);
  const auto landing = std::ranges::find_if(
      landings, [&](const Happening& h) { return h.time > edges.front().time; });
  ASSERT_NE(landing, landings.end());
  EXPECT_NEAR(landing->p.x() - edges.front().p.x(), ProbeOptions{}.beyond, 0.01);
  EXPECT_NEAR(landing->p.z(), -0.10, 2e-3);
}

TEST(Planner, AllocatesNothingInATick) {
  Puppet puppet = walker(probing(), step_at(0.45, -0.10));
  RobotState state;
  state.time = 0.0;
  state.p_WB = Vec3(0.0, 0.0, 0.46);
  state.q_WB = Quat::Identity();
  state.v_WB = state.w_WB_B = Vec3::Zero();
  Dynamics dynamics;
  dynamics.com.p = state.p_WB;
  Planner planner(probing(), Puppet::kWeight, kPeriod);
  std::size_t most = 0;
  puppet.run(20.0, [&] {
    state.time = puppet.time();
    dynamics.com.p.head<2>() = puppet.com();
    for (const Leg leg : kLegs) {
      dynamics.foot[index(leg)].p = puppet.foot(leg);
      state.foot_force[index(leg)] = puppet.force(leg);
    }
    const test::MallocCounter counter;
    (void)planner.update(puppet.user, state, dynamics);
    most = std::max(most, counter.count());
  });
  EXPECT_GT(planner.steps_taken(), 8);
  EXPECT_EQ(most, 0u);
}

}  // namespace
}  // namespace surefoot
