// The walk where the ground is not what was expected.
#include "surefoot/math/rotation.hpp"
#include "tests/gaits/watch.hpp"
#include "tests/support/random_hierarchy.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::gaits {
namespace {

TEST(Planner, WaitsWhileAFootLooksForGroundThatLiesLower) {
  test::Puppet puppet = test::walker({}, test::step_at(0.40, -0.10));
  test::run_watched(puppet, 40.0);
  const std::vector<test::Happening> late = puppet.happenings(PlanEvent::late);
  ASSERT_GE(late.size(), 2u);
  for (const test::Happening& wait : late) {
    const auto next = std::ranges::find_if(puppet.happenings(), [&](const test::Happening& h) {
      return h.time > wait.time && h.event != PlanEvent::late;
    });
    ASSERT_NE(next, puppet.happenings().end());
    EXPECT_EQ(next->event, PlanEvent::touchdown) << "nothing else happens meanwhile";
    EXPECT_NEAR(next->p.z(), -0.10, 2e-3);
  }
  test::stop(puppet);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), -0.10, 2e-3) << "all went down";
  EXPECT_NEAR(puppet.plan().torso.height, -0.10 + StanceOptions{}.height, 2e-3);
}

TEST(Planner, StaysOverTheOtherFeetWhileItWaits) {
  PlannerOptions options;
  options.swing.search_depth_max = 4.0;  // a search of 20 s
  test::Puppet puppet = test::walker(options, test::step_at(0.40, -3.0));
  test::run_watched(puppet, 12.0);
  ASSERT_GT(puppet.happenings(PlanEvent::late).size(), 0u);
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

TEST(Planner, TakesFeetBackAndStaysWhereThereIsNoGroundAhead) {
  const double edge = 0.45;
  test::Puppet puppet = test::walker({}, test::step_at(edge, test::kNoGround));
  test::run_watched(puppet, 120.0);
  const std::vector<test::Happening> back = puppet.happenings(PlanEvent::no_ground);
  const std::vector<test::Happening> landings = puppet.happenings(PlanEvent::touchdown);
  ASSERT_GT(back.size(), 2u);
  EXPECT_LT(back.size(), landings.size() / 2) << "it knows in the end";
  for (const test::Happening& landing : landings) {
    EXPECT_LE(landing.p.x(), edge);
    EXPECT_NEAR(landing.p.z(), 0.0, 1e-3);
  }
  for (const Leg leg : kLegs) EXPECT_LE(puppet.foot(leg).x(), edge);
  const test::Happening landed = puppet.first_after(back.front().time, PlanEvent::touchdown);
  ASSERT_EQ(landed.event, PlanEvent::touchdown);
  EXPECT_EQ(landed.leg, back.front().leg) << "the foot that was taken back stands again";
}

/// No ground from x = `edge` to `edge` + `width`.
test::Ground ditch(double edge, double width) {
  return
      [=](const Vec2& p) { return p.x() > edge && p.x() < edge + width ? test::kNoGround : 0.0; };
}

TEST(Planner, ChoosesAnotherPlaceWhereAFootFoundNoGround) {
  int met = 0;
  for (const double edge : {0.42, 0.44, 0.46, 0.48, 0.50, 0.52, 0.54}) {
    test::Puppet puppet = test::walker({}, ditch(edge, 0.10));
    test::run_watched(puppet, 90.0);
    met += puppet.happenings(PlanEvent::no_ground).empty() ? 0 : 1;
    for (const Leg leg : kLegs) EXPECT_GT(puppet.foot(leg).x(), edge) << "crossed, " << edge;
    for (const test::Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
      EXPECT_NEAR(landing.p.z(), 0.0, 1e-3);
    }
  }
  EXPECT_GT(met, 3) << "feet did find none";
}

TEST(Planner, AnotherFootGoesFirstWhereTheOthersWouldStandInALine) {
  for (const bool forward : {true, false}) {
    const Leg close = forward ? Leg::RF : Leg::RH;  // the first to go is the one across
    test::Puppet puppet;
    puppet.place(close, 0.15 * puppet.foot(close).head<2>());  // nearly between two others
    puppet.run(3.0);
    puppet.user = test::walking(forward ? 0.06 : -0.06);
    test::run_watched(puppet, 30.0);
    EXPECT_GT(puppet.happenings(PlanEvent::support_widened).size(), 0u) << index(close);
    EXPECT_LT(puppet.happenings(PlanEvent::support_widened).size(), 3u) << index(close);
    EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off_aborted).empty()) << index(close);
    EXPECT_GT(puppet.planner().steps_taken(), 10) << "the gait goes on";
  }
}

TEST(Planner, GroundThatLiesHigherIsMetEarly) {
  test::Puppet puppet = test::walker({}, test::step_at(0.40, 0.05));
  test::run_watched(puppet, 40.0);
  test::stop(puppet);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), 0.05, 2e-3) << "all went up";
  EXPECT_NEAR(puppet.plan().torso.height, 0.05 + StanceOptions{}.height, 2e-3);
}

TEST(Planner, OnlyAHindFootThatKnowsTheGroundRefusesOneThatLiesHigher) {
  PlannerOptions options;
  options.foothold.hind_use_front_prints = false;
  test::Puppet puppet = test::walker(options, test::step_at(0.40, 0.08));
  puppet.run(40.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::collision).empty());
  puppet.user.walk = false;
  puppet.run(4.0);
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), 0.08, 2e-3) << "all went up";
}

TEST(Planner, AHindFootDoesNotRefuseGroundAsHighAsItsLegFolds) {
  for (const bool folded : {false, true}) {
    test::Puppet puppet = test::walker();
    puppet.run(12.0);
    const auto rises = [&] { return puppet.foot(Leg::LH).z() > 0.07; };
    while (!rises() && puppet.time() < 20.0) puppet.tick();
    ASSERT_TRUE(rises());
    if (folded) puppet.leg_length = 0.15;
    puppet.ground = test::level_ground(0.06);  // that no front foot found
    puppet.run(1.0);
    EXPECT_EQ(puppet.happenings(PlanEvent::collision).empty(), folded);
  }
}

TEST(Planner, LeansWithTheSlopeThatItsFeetFind) {
  const double slope = 0.15;
  const test::Ground ramp = [=](const Vec2& p) { return slope * std::max(0.0, p.x() - 0.5); };
  test::Puppet puppet = test::walker({}, ramp);
  test::run_watched(puppet, 60.0);
  const Vec3 normal = Vec3(-slope, 0.0, 1.0).normalized();
  EXPECT_LT((puppet.planner().terrain_normal() - normal).norm(), 0.01);
  EXPECT_LT((puppet.plan().torso.q_WB * Vec3::UnitZ() - normal).norm(), 0.01);
  EXPECT_LT((puppet.plan().R_WC.col(2) - normal).norm(), 0.01);
}

TEST(Planner, OwnGroundThatIsGoneForAWhileIsNotAvoidedBehindThat) {
  const auto landings = [](bool is_gone) {
    test::Puppet puppet;
    puppet.run(0.5);
    const Vec2 place = puppet.foot(Leg::RF).head<2>();
    if (is_gone) {
      puppet.ground = [=](const Vec2& p) {
        return (p - place).norm() < 0.03 ? test::kNoGround : 0.0;
      };
    }
    puppet.run(2.0);
    puppet.ground = test::level_ground();
    puppet.run(3.0);
    EXPECT_EQ(puppet.happenings(PlanEvent::no_ground).size(), is_gone ? 1u : 0u);
    puppet.user = test::walking();
    puppet.run(40.0);
    std::vector<Vec3> result;
    for (const test::Happening& h : puppet.happenings(PlanEvent::touchdown))
      if (h.leg == Leg::RH) result.push_back(h.p);
    return result;
  };
  const std::vector<Vec3> with = landings(true), without = landings(false);
  ASSERT_GT(std::min(with.size(), without.size()), 5u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_LT((with[i] - without[i]).norm(), 5e-3) << i;
}

TEST(Planner, AStanceFootThatLosesItsGroundGoesDownForIt) {
  test::Puppet puppet;
  puppet.run(0.5);
  const double z = puppet.foot(Leg::RH).z();
  puppet.ground = [](const Vec2& p) { return p.x() < 0.0 && p.y() < 0.0 ? -0.05 : 0.0; };
  puppet.run(2.0);
  ASSERT_EQ(puppet.happenings(PlanEvent::lost_contact).size(), 1u);
  EXPECT_EQ(puppet.happenings(PlanEvent::lost_contact).front().leg, Leg::RH);
  ASSERT_EQ(puppet.happenings(PlanEvent::touchdown).size(), 1u);
  EXPECT_NEAR(puppet.foot(Leg::RH).z(), z - 0.05, 1e-3);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  puppet.user = test::walking();
  test::run_watched(puppet, 10.0);
  EXPECT_GT(puppet.planner().steps_taken(), 4);
}

TEST(Planner, NothingBeginsAnewWhileAFootSearches) {
  test::Puppet puppet;
  puppet.run(3.0);
  puppet.ground = [](const Vec2& p) { return p.x() < 0.0 && p.y() < 0.0 ? -0.05 : 0.0; };
  bool searched = false;
  puppet.run(8.0, [&] {
    const bool searches = puppet.plan().feet[index(Leg::RH)].phase == LegPhase::search;
    searched = searched || searches;
    puppet.user.calibrate = searched;
    EXPECT_TRUE(!puppet.planner().restarts() || puppet.plan().num_contacts() == 4);
  });
  EXPECT_TRUE(searched);
  EXPECT_EQ(puppet.happenings(PlanEvent::calibration).size(), 1u) << "once it stands again";
}

TEST(Planner, TheComComesToRestWhileALostFootSearches) {
  test::Puppet puppet = test::walker();
  while (puppet.time() < 5.0 || puppet.plan().num_contacts() < 4) puppet.tick();
  const Vec2 place = puppet.foot(Leg::RF).head<2>(), com = puppet.com();
  puppet.ground = [place](const Vec2& p) {
    return (p - place).norm() < 0.3 ? test::kNoGround : 0.0;
  };
  const double lost_at = puppet.time();
  int searched = 0;
  puppet.run(2.0, [&] {
    if (puppet.plan().feet[index(Leg::RF)].phase != LegPhase::search) return;
    const ComPlan& plan = puppet.plan().com;
    ++searched;
    EXPECT_LT((plan.p - com).norm(), 0.04);
    EXPECT_TRUE(puppet.time() < lost_at + 1.2 || plan.v.norm() < 1e-6);
  });
  EXPECT_GT(searched, 300);
}

TEST(Planner, TheHeadingWaitsForAFootThatSearches) {
  test::Puppet puppet = test::walker();
  puppet.user = {.walk = true, .velocity = {0.0, 0.0}, .yaw_rate = 0.1};
  const auto heading = [&] { return yaw(puppet.plan().torso.q_WB.toRotationMatrix()); };
  while (puppet.plan().num_contacts() < 4 || puppet.time() < 3.0) puppet.tick();
  ASSERT_GT(heading(), 0.1) << "it turns";
  puppet.ground = [](const Vec2& p) { return p.x() < 0.0 && p.y() < 0.0 ? test::kNoGround : 0.0; };
  int waited = 0;
  double before = kNaN;
  puppet.run(1.0, [&] {
    const bool searches = puppet.plan().feet[index(Leg::RH)].phase == LegPhase::search;
    if (searches && std::isfinite(before)) {
      ++waited;
      EXPECT_NEAR(heading(), before, 1e-9);
      EXPECT_NEAR(puppet.plan().torso.w_WB.z(), 0.0, 1e-9);
    }
    before = searches ? heading() : kNaN;
  });
  EXPECT_GT(waited, 100);
}

TEST(Planner, WhatAFootFoundThatFliesOffIsTakenBack) {
  test::Puppet puppet = test::walker({}, test::step_at(0.40, 0.05));
  Vec3 before = puppet.plan().terrain_point;
  const auto found = [&] {
    const std::vector<test::Happening>& all = puppet.happenings();
    return !all.empty() && all.back().event == PlanEvent::touchdown && all.back().p.z() > 0.04;
  };
  while (!found() && puppet.time() < 40.0) {
    before = puppet.plan().terrain_point;
    puppet.tick();
  }
  ASSERT_TRUE(found());
  EXPECT_GT((puppet.plan().terrain_point - before).norm(), 5e-3) << "a foot higher up";
  puppet.fling(puppet.happenings().back().leg, {0.0, 0.0, -0.03}, {0.0, 0.0, -1.0});
  puppet.tick();
  EXPECT_EQ(puppet.happenings().back().event, PlanEvent::lost_contact);
  EXPECT_LT((puppet.plan().terrain_point - before).norm(), 1e-9);
}

TEST(Planner, WhereAFootHasLittleFrictionStepsAreShorterAndTakeLonger) {
  PlannerOptions options;
  options.grip.recovery = 0.0;
  test::Puppet puppet = test::walker(options);
  puppet.user.walk = false;
  puppet.run(2.0);
  puppet.slide[index(Leg::LF)] = Vec2(3.0, 0.0);
  puppet.tick();
  puppet.slide.fill(Vec2::Zero());
  const double caution = options.grip.enough / options.grip.friction_min;
  puppet.user.walk = true;
  test::run_watched(puppet, 10.0);
  const double begin = puppet.com().x();
  const int steps = puppet.planner().steps_taken();
  constexpr double kDuration = 60.0;
  test::run_watched(puppet, kDuration);
  EXPECT_NEAR((puppet.com().x() - begin) / kDuration, 0.06 / caution, 0.1 * 0.06 / caution);
  const double usual = kDuration / 3.8 * 4.0;  // a cycle of 3.8 s
  EXPECT_NEAR(puppet.planner().steps_taken() - steps, usual / std::sqrt(caution), 3.0);
}

// On both sides of a step the plane through the feet is no ground: pyramids that stand upright are
// what a foot slides out of.
TEST(Planner, TheFrictionOfASlidingFootIsThatOfItsPyramid) {
  for (const bool upright : {true, false}) {
    test::Puppet puppet = test::walker({}, test::step_at(0.0, 0.14));
    puppet.user.walk = false;
    if (upright) puppet.last.pyramid_normal.fill(Vec3::UnitZ());
    puppet.run(1.0);
    puppet.slide[index(Leg::LF)] = Vec2(30.0, 0.0);
    puppet.tick();
    const Vec3& force = puppet.force(Leg::LF);
    const double slope = 0.14 / (2.0 * StanceOptions{}.half_length);  // up ahead
    const double ratio = force.x() / force.z();
    const double inclined = (ratio + slope) / (1.0 - ratio * slope);
    const GripOptions grip;
    const double expected = grip.share * (upright ? ratio : inclined);
    EXPECT_NEAR(puppet.plan().feet[index(Leg::LF)].friction,
                std::clamp(expected, grip.friction_min, ForceOptions{}.friction), 1e-9)
        << upright;
  }
}

/// The happenings that follow a lift-off, up to the landing.
std::vector<PlanEvent> swing_from(const test::Puppet& puppet, const test::Happening& lift) {
  std::vector<PlanEvent> events;
  for (const test::Happening& h : puppet.happenings()) {
    const bool ended = !events.empty() && events.back() == PlanEvent::touchdown;
    if (h.time > lift.time && !ended) events.push_back(h.event);
  }
  return events;
}

TEST(Planner, AFrontFootTouchesTwiceWhereItProbesAndAHindFootOnce) {
  test::Puppet puppet = test::walker(test::probing());
  test::run_watched(puppet, 30.0);
  const std::vector<PlanEvent> once{PlanEvent::touchdown};
  const std::vector<PlanEvent> twice{PlanEvent::probe_same_ground, PlanEvent::touchdown};
  const std::vector<test::Happening> lifts = puppet.happenings(PlanEvent::lift_off);
  ASSERT_GT(lifts.size(), 12u);
  for (std::size_t i = 0; i + 1 < lifts.size(); ++i) {
    EXPECT_EQ(swing_from(puppet, lifts[i]), is_front(lifts[i].leg) ? twice : once);
  }
  const std::vector<test::Happening> probes = puppet.happenings(PlanEvent::probe_same_ground);
  for (std::size_t i = 0; i + 1 < probes.size(); ++i) {
    const test::Happening landing = puppet.first_after(probes[i].time, PlanEvent::touchdown);
    EXPECT_EQ(landing.leg, probes[i].leg);
    EXPECT_NEAR(probes[i].p.x() - landing.p.x(), ProbeOptions{}.ahead, 0.01);
  }
}

TEST(Planner, NoFootLandsOnAnEdgeThatItsProbesCanFind) {
  test::RandomMatrices random(2);
  for (int trial = 0; trial < 10; ++trial) {
    const double edge = random.uniform(0.40, 0.62), height = random.uniform(-0.15, -0.05);
    SCOPED_TRACE("edge of " + std::to_string(height) + " m at " + std::to_string(edge));
    test::Puppet puppet = test::walker(test::probing(), test::step_at(edge, height));
    puppet.user = test::walking(0.03);
    test::run_watched(puppet, 60.0);
    EXPECT_GE(puppet.happenings(PlanEvent::probe_edge).size(), 1u);
    for (const test::Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
      EXPECT_GT(std::abs(landing.p.x() - edge), 0.03) << "at " << landing.time;
    }
    test::stop(puppet);
    for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), height, 2e-3);
  }
}

TEST(Planner, AnEdgeThatAProbeFindsIsLeftBehind) {
  test::Puppet puppet = test::walker(test::probing(), test::step_at(0.45, -0.10));
  puppet.user = test::walking(0.03);
  puppet.run(40.0);
  const std::vector<test::Happening> edges = puppet.happenings(PlanEvent::probe_edge);
  ASSERT_FALSE(edges.empty());
  const test::Happening landing = puppet.first_after(edges.front().time, PlanEvent::touchdown);
  ASSERT_EQ(landing.event, PlanEvent::touchdown);
  EXPECT_NEAR(landing.p.x() - edges.front().p.x(), ProbeOptions{}.beyond, 0.01);
  EXPECT_NEAR(landing.p.z(), -0.10, 2e-3);
}

}  // namespace
}  // namespace surefoot::gaits
