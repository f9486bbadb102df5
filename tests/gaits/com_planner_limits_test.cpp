// What the planner of the centre of mass does with hard, wrong or too many phases.
#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/sensor_reading.hpp"
#include "tests/gaits/com_plans.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace surefoot::gaits {
namespace {

TEST(ComPlanner, IsFiniteWhateverFeetAreDown) {
  test::RandomMatrices random(10);
  ComPlanner planner = test::make_planner();
  for (int trial = 0; trial < 200; ++trial) {
    SCOPED_TRACE("trial " + std::to_string(trial));
    test::Phases phases;
    const int count = random.integer(1, ComPlanner::kMaxPhases);
    for (int i = 0; i < count; ++i) {
      SupportPhase phase = test::standing(random.uniform(0.0, 1.0), test::nominal_feet());
      for (std::size_t k = 0; k < kNumLegs; ++k) {
        phase.feet[k] = random.chance(0.2) ? phase.feet[0] : Vec2(random.vector(2));
        phase.down[k] = random.chance(0.6);
        phase.loaded_for[k] = random.uniform(-0.1, 0.2);
        phase.lifts_in[k] = random.chance(0.5) ? kInfinity : random.uniform(-0.5, 0.5);
      }
      phase.must_rest = random.chance(0.5);
      phases.push_back(phase);
    }
    test::plan(planner, phases, 1.0, {random.vector(2), random.vector(2), random.vector(2)},
               random.vector(2));
    EXPECT_TRUE(std::isfinite(planner.zmp_slack()));
    EXPECT_GE(planner.zmp_slack(), 0.0);
    for (double t = 0.9; t < planner.end_time() + 0.1; t += 0.05) {
      const ComPlan at = planner.at(t);
      ASSERT_TRUE(at.p.allFinite() && at.v.allFinite() && at.a.allFinite() && at.zmp.allFinite());
    }
  }
}

TEST(ComPlanner, AgainstALoadAsksForNoMoreAlongTheGroundThanFrictionGives) {
  constexpr double kFriction = 0.5;
  const Vec2 force(0.0, 0.2);  // of the weight
  ComPlanner planner = test::make_planner();
  const test::Phases phases{test::standing(1.0, test::nominal_feet())};
  test::plan(planner, phases, 0.0, {{0.0, 0.0}, {0.0, 0.25}, {0.0, 0.0}}, Vec2::Zero(),
             {.load = {.force = force}, .friction = kFriction});
  test::over(phases, 0.0, [&](const SupportPhase&, double, double t) {
    const Vec2 along = planner.at(t).a / kGravity - force;
    EXPECT_LT(along.lpNorm<Eigen::Infinity>(), kFriction / std::numbers::sqrt2) << t;
  });
}

TEST(ComPlanner, FrictionIsThatOfPyramidsThatLookWhereTheHeadingDoes) {
  constexpr double kFriction = 0.3;
  const auto begin_of = [](double heading) {
    const Mat2 R = rotation_about_z(heading).topLeftCorner<2, 2>();
    ComPlanner planner = test::make_planner();
    SupportPhase phase = test::standing(1.0, test::nominal_feet());
    for (Vec2& foot : phase.feet) foot = R * foot;
    test::plan(planner, {phase}, 0.0, {{0.0, 0.0}, R * Vec2(0.1, 0.05), {0.0, 0.0}}, Vec2::Zero(),
               {.load = {.force = R * Vec2(0.18, 0.0)}, .friction = kFriction, .heading = heading});
    return Vec2(R.transpose() * planner.at(0.2).a);
  };
  for (const double heading : {0.3, kPi / 4.0, 2.0})
    EXPECT_LT((begin_of(heading) - begin_of(0.0)).norm(), 1e-6) << heading;
}

/// Standing for a second on legs that reach no further than `reach`, hips over their feet.
test::Phases on_short_legs(double reach) {
  SupportPhase phase = test::standing(1.0, test::nominal_feet());
  phase.hips = phase.feet;
  phase.reach.fill(reach);
  return {phase};
}

double furthest_hip(const ComPlanner& planner, const test::Phases& phases) {
  double furthest = 0.0;
  test::over(phases, 0.0, [&](const SupportPhase& phase, double, double t) {
    for (std::size_t k = 0; k < kNumLegs; ++k) {
      const Vec2 from_foot = planner.at(t).p + phase.hips[k] - phase.feet[k];
      furthest = std::max(furthest, from_foot.norm());
    }
  });
  return furthest;
}

TEST(ComPlanner, AgainstALoadKeepsEveryHipWhereItsLegReachesIt) {
  constexpr double kReach = 0.05;
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    ComPlanner planner = test::make_planner({.terminal_weight = 100.0});
    const ComProblem loaded{.load = {.force = 0.2 * Vec2(std::cos(angle), std::sin(angle))},
                            .friction = 1.0};
    const auto plan_again = [&](double reach) {
      for (int i = 0; i < 5; ++i)
        test::plan(planner, on_short_legs(reach), 0.0, {{0, 0}, {0, 0}, {0, 0}}, Vec2::Zero(),
                   loaded);
    };
    // The rows are tangents where the plan before was, so that of a first plan is not bounded yet.
    plan_again(kReach);
    EXPECT_LT(furthest_hip(planner, on_short_legs(kReach)), 1.05 * kReach) << angle;
    EXPECT_EQ(planner.zmp_slack(), 0.0);
    plan_again(1.0);
    EXPECT_GT(furthest_hip(planner, on_short_legs(1.0)), 1.5 * kReach) << "longer legs lean more";
  }
}

TEST(ComPlanner, WithoutALoadHipsAndReachChangeNothing) {
  test::RandomMatrices random(14);
  for (int trial = 0; trial < test::kTrials; ++trial) {
    const test::Phases phases = test::random_walk(random);
    test::Phases reaching = phases;
    for (SupportPhase& phase : reaching) {
      for (Vec2& hip : phase.hips) hip = 0.5 * Vec2(random.vector(2));
      phase.reach.fill(random.uniform(0.0, 0.2));
    }
    const Motion<Vec2> start = test::random_start(random);
    ComPlanner without = test::make_planner(), with = test::make_planner();
    for (int again = 0; again < 2; ++again) {
      test::plan(without, phases, 0.0, start);
      test::plan(with, reaching, 0.0, start);
    }
    for (double t = 0.0; t < without.end_time(); t += 0.0513) {
      ASSERT_EQ(with.at(t).p, without.at(t).p) << trial;
      ASSERT_EQ(with.at(t).a, without.at(t).a) << trial;
    }
  }
}

/// Least margin of the capture point in the regions of a plan that bears a load.
double least_rest_margin(const ComPlanner& planner, const test::Phases& phases, const Vec2& shift) {
  double least = kInfinity;
  test::over(phases, 0.0, [&](const SupportPhase& phase, double t, double at) {
    const ComPlan com = planner.at(at);
    const Vec2 capture_point = com.p + std::sqrt(test::kHeight / kGravity) * com.v + shift;
    least = std::min(least, test::region(planner, phase, t).margin(capture_point));
  });
  return least;
}

TEST(ComPlanner, AgainstALoadTheCapturePointStaysInsideThoughThePhaseNeedNotRest) {
  const ComPlannerOptions options;
  const test::Phases phases{test::standing(2.0, test::nominal_feet())};  // time enough to stop late
  const Vec2 force(0.0, 0.1);
  ComPlanner planner = test::make_planner(options);
  test::plan(planner, phases, 0.0, {{0.0, 0.0}, {0.0, 0.4}, {0.0, 0.0}}, Vec2::Zero(),
             {.load = {.force = force}, .friction = 1.0});
  EXPECT_GT(least_rest_margin(planner, phases, test::kHeight * force), 0.9 * options.rest_margin);
}

TEST(ComPlanner, APhaseCanLetTheZmpComeNearerToTheEdgesThanUsual) {
  constexpr double kUsual = 0.06, kNear = 0.01;
  const Motion<Vec2> start{{0.0, 0.1}, {0.0, 0.25}, {0, 0}};
  const auto margin_with = [&](double zmp_margin_max) {
    test::Phases phases{test::standing(1.0, test::nominal_feet())};
    phases.front().zmp_margin_max = zmp_margin_max;
    ComPlanner planner = test::make_planner({.zmp_margin = kUsual, .terminal_weight = 100.0});
    test::plan(planner, phases, 0.0, start);
    double least = kInfinity;
    test::over(phases, 0.0, [&](const SupportPhase& phase, double t, double at) {
      if (t > 0.2)
        least = std::min(least, test::region(planner, phase, t).margin(planner.at(at).zmp));
    });
    return least;
  };
  EXPECT_GT(margin_with(kInfinity), 0.5 * kUsual);
  EXPECT_LT(margin_with(kNear), margin_with(kInfinity) - 0.5 * (kUsual - kNear));
  EXPECT_EQ(margin_with(kInfinity), margin_with(2.0 * kUsual)) << "never further off than usual";
}

TEST(ComPlanner, LetsNoLegCarryMoreThanItsShare) {
  ComPlanner planner = test::make_planner({.leg_share = 0.6});
  const SupportPhase phase = test::standing(1.0, test::nominal_feet());
  for (std::size_t k = 0; k < kNumLegs; ++k)
    EXPECT_EQ(planner.share(phase, k, 0.5, test::kWeight), 0.6);
  EXPECT_LT(test::region(planner, phase, 0.5).margin(phase.feet[0]), -0.05);
}

TEST(ComPlanner, WithoutAnyPhaseKeepsTheLastPlan) {
  ComPlanner planner = test::make_planner();
  EXPECT_EQ(planner.at(3.0).p, Vec2::Zero());
  test::plan(planner, test::walk(1, test::nominal_feet(), {0.1, 0.0}), 0.0,
             {{0.01, 0.02}, {0, 0}, {0, 0}});
  const Vec2 before = planner.at(1.0).p;
  test::plan(planner, {}, 0.5, {{9.0, 9.0}, {0, 0}, {0, 0}});
  EXPECT_EQ(planner.at(1.0).p, before);
}

TEST(ComPlanner, KeepsTheLastPlanWhereTheNewOneWouldBeNoNumber) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    ComPlanner planner = test::make_planner();
    const test::Phases phases = test::walk(1, test::nominal_feet(), {0.1, 0.0});
    test::plan(planner, phases, 0.0, {{0.01, 0.02}, {0, 0}, {0, 0}});
    const ComPlanner& now = planner;
    const ComPlan before = now.at(1.0);
    const double end = now.end_time();
    test::plan(planner, phases, 0.5, {{bad, 0.0}, {0, 0}, {0, 0}});
    test::plan(planner, phases, 0.5, {{0, 0}, {0.0, bad}, {0, 0}});
    test::plan(planner, phases, 0.5, {{0, 0}, {0, 0}, {0, 0}}, {bad, 0.0});
    EXPECT_EQ(now.at(1.0).p, before.p);
    EXPECT_EQ(now.at(1.0).zmp, before.zmp);
    EXPECT_EQ(now.end_time(), end);
  }
}

TEST(ComPlanner, HoldsTheZmpInsideToTheEndOfAPhaseWhoseRegionHasManyEdges) {
  test::RandomMatrices random(13);
  ComPlanner planner = test::make_planner({.terminal_weight = 100.0});
  const SupportPhase stand = test::standing(1.0, test::nominal_feet());
  ASSERT_GT(test::region(planner, stand, 1.0).num_edges(), 6) << "all four corners are cut off";
  for (int trial = 0; trial < test::kTrials; ++trial) {
    const double angle = random.uniform(-3.0, 3.0);  // which asks for much at the end
    test::plan(planner, {stand}, 0.0, {{0, 0}, {0, 0}, {0, 0}},
               1.5 * Vec2(std::cos(angle), std::sin(angle)));
    EXPECT_LT(planner.zmp_slack(), 1e-6);
  }
}

TEST(ComPlanner, LeavesOutPhasesThatAreTooShortOrTooMany) {
  ComPlanner planner = test::make_planner();
  const SupportPhase stand = test::standing(0.5, test::nominal_feet());
  test::Phases phases{stand};
  for (const double duration : {0.0, 1e-4, -1.0, kNaN}) {
    phases.push_back(test::standing(duration, test::nominal_feet()));
  }
  test::plan(planner, phases, 0.0, {{0, 0}, {0, 0}, {0, 0}});
  EXPECT_NEAR(planner.end_time(), 0.5, 1e-12);
  test::plan(planner, test::Phases(ComPlanner::kMaxPhases + 5, stand), 0.0,
             {{0, 0}, {0, 0}, {0, 0}});
  EXPECT_NEAR(planner.end_time(), 0.5 * ComPlanner::kMaxPhases, 1e-12);
}

TEST(ComPlanner, AFootsShareRampsUpFromTouchdownAndDownToLiftOff) {
  const ForceOptions force{.max = 240.0, .ramp_up = 0.1, .ramp_down = 0.2};
  const ComPlanner planner({.leg_share = 1.0}, force);
  SupportPhase phase = test::standing(1.0, test::nominal_feet());
  phase.loaded_for[0] = 0.0;
  phase.lifts_in[0] = 0.8;
  const auto share = [&](std::size_t leg, double t, double weight = test::kWeight) {
    return planner.share(phase, leg, t, weight);
  };
  EXPECT_NEAR(share(0, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(share(0, 0.05), 0.4, 1e-12);
  EXPECT_NEAR(share(0, 0.3), 0.8, 1e-12);
  EXPECT_NEAR(share(0, 0.7), 0.4, 1e-12);
  EXPECT_NEAR(share(0, 0.8), 0.0, 1e-12);
  EXPECT_NEAR(share(0, 0.9), 0.0, 1e-12);
  EXPECT_NEAR(share(1, 0.5), 0.8, 1e-12);
  EXPECT_NEAR(share(1, 0.5, 1.25 * test::kWeight), 0.64, 1e-12) << "of a heavier robot";
  phase.down[1] = false;
  EXPECT_EQ(share(1, 0.5), 0.0);
}

TEST(ComPlanner, WithoutRampsOrWithRampsOfNoLengthAFootCarriesAllAtOnce) {
  for (const ForceOptions& force : {ForceOptions{.max = 240.0, .ramps = false},
                                    ForceOptions{.max = 240.0, .ramp_up = 0.0, .ramp_down = 0.0}}) {
    const ComPlanner planner({.leg_share = 1.0}, force);
    SupportPhase phase = test::standing(0.5, test::nominal_feet());
    phase.loaded_for[0] = 0.0;
    phase.lifts_in[0] = 0.5;
    for (const double t : {0.001, 0.1, 0.499})
      EXPECT_NEAR(planner.share(phase, 0, t, test::kWeight), 0.8, 1e-12);
    EXPECT_TRUE(std::isfinite(planner.share(phase, 0, 0.5, test::kWeight)));
    EXPECT_TRUE(std::isfinite(planner.share(phase, 0, 0.0, test::kWeight)));
  }
}

}  // namespace
}  // namespace surefoot::gaits
