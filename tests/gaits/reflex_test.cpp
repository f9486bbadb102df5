// What a foot does that meets something on its way.
#include "tests/gaits/watch.hpp"

#include <algorithm>
#include <string>

namespace surefoot::gaits {
namespace {

const Vec3 kUp = Vec3::UnitZ();
const Vec3 kForward = Vec3::UnitX();
constexpr double kDuration = 0.5;  // of the swing [s]

PlannerOptions with(const ReflexOptions& reflex) {
  PlannerOptions options;
  options.reflex = reflex;
  return options;
}

/// A foot that goes a stride forward, `behind` its reference and under a force.
struct Foot {
  explicit Foot(const ReflexOptions& reflex = {}) : leg(with(reflex), test::kPeriod) {
    leg.plant(-5.0, Vec3::Zero());
    leg.lift(0.0, {Vec3::Zero(), 0.2 * kForward, kUp, kDuration, 0.08});
  }

  /// From one share of the swing to another.
  LegEvent follow(double from, double to, const Vec3& behind, const Vec3& force) {
    LegEvent event = LegEvent::none;
    for (double t = from * kDuration; t < to * kDuration && event == LegEvent::none;
         t += test::kPeriod) {
      const FootPlan plan = leg.plan(t);
      const model::PointKinematics hip{.p = plan.p_WF + 0.3 * kUp};
      const model::PointKinematics foot{.p = plan.p_WF - behind, .v = plan.v_WF};
      event = leg.observe(t, {hip, foot, force, kUp, 0.0});
    }
    return event;
  }

  LegMotion leg;
};

TEST(Reflex, AFootThatIsHeldBackIsCaughtAndNoOther) {
  const Vec3 held = 0.12 * kForward, back = -10.0 * kForward, none = Vec3::Zero();
  EXPECT_EQ(Foot().follow(0.3, 0.7, held, back), LegEvent::caught);
  EXPECT_EQ(Foot().follow(0.05, 0.3, 0.12 * kUp, -10.0 * kUp), LegEvent::caught) << "as it rises";
  EXPECT_EQ(Foot().follow(0.05, 1.0, none, back), LegEvent::none) << "it follows";
  EXPECT_EQ(Foot().follow(0.05, 1.0, held, none), LegEvent::none) << "it lags without a force";
  EXPECT_EQ(Foot().follow(0.4, 0.6, 0.05 * kForward, back), LegEvent::none) << "fast, a bit late";
  EXPECT_EQ(Foot().follow(0.1, 0.4, -held, -back), LegEvent::none) << "it is pushed ahead";
  EXPECT_EQ(Foot({.enabled = false}).follow(0.1, 0.9, held, back), LegEvent::none);
}

TEST(Reflex, AWallIsNoGround) {
  const Vec3 wall = -60.0 * kForward + 30.0 * kUp, ground = -30.0 * kForward + 60.0 * kUp;
  EXPECT_EQ(Foot().follow(0.55, 0.58, Vec3::Zero(), wall), LegEvent::none);
  EXPECT_EQ(Foot().follow(0.55, 0.7, Vec3::Zero(), wall), LegEvent::caught);
  EXPECT_EQ(Foot().follow(0.55, 0.7, Vec3::Zero(), ground), LegEvent::touchdown);
}

// A riser's edge bears a foot that comes down on it from before, hardly behind its reference.
TEST(Reflex, AHardHitNeedsNoLag) {
  const Vec3 edge = -120.0 * kForward + 100.0 * kUp;
  EXPECT_EQ(Foot().follow(0.5, 0.54, Vec3::Zero(), edge), LegEvent::none) << "an impact is short";
  EXPECT_EQ(Foot().follow(0.5, 0.56, Vec3::Zero(), edge), LegEvent::caught);
  EXPECT_EQ(Foot().follow(0.05, 0.3, Vec3::Zero(), -30.0 * kUp), LegEvent::caught);
  EXPECT_EQ(Foot({.hit_force = 200.0}).follow(0.5, 0.56, Vec3::Zero(), edge), LegEvent::none);
}

TEST(Reflex, AFootFarBesideItsWayFeelsItsDrivesAndNoGroundUntilItIsAboutToArrive) {
  const Vec3 beside = 0.06 * Vec3::UnitY(), light = 15.0 * kUp, impact = 40.0 * kUp;
  EXPECT_EQ(Foot().follow(0.55, 0.75, Vec3::Zero(), light), LegEvent::touchdown);
  EXPECT_EQ(Foot().follow(0.55, 0.75, beside, light), LegEvent::none);
  EXPECT_EQ(Foot().follow(0.55, 0.75, beside, impact), LegEvent::touchdown);
  EXPECT_EQ(Foot().follow(0.85, 0.95, beside, light), LegEvent::touchdown);
}

TEST(Reflex, AFootThatEndsItsSwingFarFromItsGoalSearchesBelowItself) {
  const Vec3 goal = 0.2 * kForward;
  Foot foot;
  EXPECT_EQ(foot.follow(0.0, 1.0, 0.1 * kForward, Vec3::Zero()), LegEvent::none);
  EXPECT_LT((foot.leg.plan(kDuration - test::kPeriod).p_WF - goal).norm(), 0.01);
  EXPECT_EQ(foot.follow(1.0, 1.02, 0.1 * kForward, Vec3::Zero()), LegEvent::none);
  const Vec3 p_WF = foot.leg.plan(1.02 * kDuration).p_WF;
  EXPECT_NEAR(p_WF.x(), 0.1, 0.005);
  EXPECT_LT(foot.leg.plan(1.02 * kDuration).v_WF.z(), -0.05);
}

TEST(Reflex, TheCurveGoesBackWhileItRisesAndThenToItsGoal) {
  const SwingTarget target{.start = kUp, .goal = kUp + 0.2 * kForward, .apex = 0.1, .back = 0.04};
  const SwingCurve curve(target, {});
  double furthest_back = 0.0;
  for (double t = 0.0; t < target.duration; t += test::kPeriod) {
    const Motion<Vec3> now = curve.at(t), next = curve.at(t + test::kPeriod);
    furthest_back = std::max(furthest_back, -now.p.x());
    ASSERT_LT((next.p - now.p - 0.5 * test::kPeriod * (now.v + next.v)).norm(), 1e-4) << t;
    if (now.p.x() > 0.0 && t > 0.1) {
      ASSERT_GT(now.p.z() + 1e-6, std::min(1.08, next.p.z())) << "over it first";
    }
  }
  EXPECT_NEAR(furthest_back, target.back, 1e-3);
  EXPECT_LT(curve.at(0.0).v.norm(), 1e-12);
  EXPECT_LT((curve.at(target.duration).p - target.goal).norm(), 1e-12);
}

/// Three feet carry meanwhile. (The reference of a foot that is caught jumps back to where it is.)
void run(test::Puppet& puppet, double duration) {
  puppet.run(duration, [&] {
    ASSERT_TRUE(test::all_finite(puppet.plan())) << puppet.time();
    ASSERT_GE(puppet.plan().num_contacts(), 3) << puppet.time();
  });
}

TEST(Planner, AFootThatARiserCatchesGoesOverIt) {
  for (const double edge : {0.38, 0.42, 0.46, 0.50}) {
    SCOPED_TRACE("edge at " + std::to_string(edge));
    const double height = 0.14;
    test::Puppet puppet = test::walker({}, test::step_at(edge, height));
    run(puppet, 40.0);
    EXPECT_FALSE(puppet.happenings(PlanEvent::caught).empty());
    for (const test::Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
      EXPECT_NEAR(landing.p.z(), landing.p.x() > edge ? height : 0.0, 2e-3);
    }
    test::stop(puppet);
    for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), height, 2e-3) << "all went up";
  }
}

TEST(Planner, AFootThatWasCaughtLandsWellBehindTheEdge) {
  const double edge = 0.45;
  test::Puppet puppet = test::walker({}, test::step_at(edge, 0.14));
  run(puppet, 30.0);
  const std::vector<test::Happening> caught = puppet.happenings(PlanEvent::caught);
  ASSERT_FALSE(caught.empty());
  const test::Happening landing = puppet.first_after(caught.front().time, PlanEvent::touchdown);
  ASSERT_EQ(landing.event, PlanEvent::touchdown);
  EXPECT_GT(landing.p.x(), edge + 0.5 * ReflexOptions{}.beyond);
}

TEST(Planner, BeforeAWallAFootComesDownAfterAFewTries) {
  const double edge = 0.45;
  test::Puppet puppet = test::walker({}, test::step_at(edge, 1.0));
  run(puppet, 30.0);
  const int most = ReflexOptions{}.most;
  const std::vector<test::Happening> caught = puppet.happenings(PlanEvent::caught);
  ASSERT_GT(caught.size(), static_cast<std::size_t>(most));
  EXPECT_EQ(caught.front().leg, caught[static_cast<std::size_t>(most)].leg) << "one swing's tries";
  for (const test::Happening& landing : puppet.happenings(PlanEvent::touchdown)) {
    EXPECT_LT(landing.p.x(), edge);
    EXPECT_NEAR(landing.p.z(), 0.0, 2e-3);
  }
  EXPECT_GT(puppet.planner().steps_taken(), 4) << "the others go on";
}

TEST(Planner, AFootIsNotLiftedHigherThanItsLegFolds) {
  test::Puppet puppet = test::walker({}, test::step_at(0.45, 1.0));
  puppet.leg_length = 0.15;
  run(puppet, 30.0);
  ASSERT_GT(puppet.happenings(PlanEvent::caught).size(), 1u);
  bool caught = false;
  for (const test::Happening& happening : puppet.happenings()) {
    if (happening.event != PlanEvent::caught && happening.event != PlanEvent::touchdown) continue;
    EXPECT_FALSE(caught && happening.event == PlanEvent::caught) << happening.time;
    caught = happening.event == PlanEvent::caught;
  }
  for (const Leg leg : kLegs) EXPECT_NEAR(puppet.foot(leg).z(), 0.0, 2e-3);
}

}  // namespace
}  // namespace surefoot::gaits
