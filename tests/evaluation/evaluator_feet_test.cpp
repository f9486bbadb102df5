// What is measured of feet: friction, slips, steps, landings.
#include "surefoot/signals/plan_event.hpp"
#include "tests/evaluation/hand_made_run.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

using test::HandMadeRun;
using test::kPeriod;

TEST(Evaluator, FrictionMarginIsOfTheWorstStanceFootThatCarries) {
  HandMadeRun run;
  run.contact(Leg::LF).force = {24.0, -32.0, 100.0};  // a ratio of 0.4, of at most 0.8
  run.contact(Leg::RF).force = {23.2, 0.0, 29.0};     // light, on the cone's boundary
  run.contact(Leg::LH).force = {64.0, 0.0, 80.0};
  run.phase(Leg::LH, LegPhase::swing);  // not a stance
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_loaded_min, 0.4, 1e-12);
  EXPECT_NEAR(run.metrics().friction_margin_min, 0.0, 1e-12);
  run.contact(Leg::RF).force = {21.0, 0.0, 30.0};  // just heavy enough
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_loaded_min, 0.1, 1e-12);
}

TEST(Evaluator, FrictionMarginFollowsTheContactsNormalAndItsFrictionAndIsZeroWithoutASign) {
  HandMadeRun run;
  const Vec3 normal = Vec3(0.6, 0.0, 0.8);
  run.contact(Leg::RH).normal = normal;
  run.contact(Leg::RH).force = 100.0 * normal + 20.0 * Vec3::UnitY();
  run.contact(Leg::RH).friction = 0.7;
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_min, 0.5, 1e-12);
  run.contact(Leg::LF).force = {80.0 + 1e-12, 0.0, 100.0};  // it slides
  run.step();
  EXPECT_EQ(run.metrics().friction_margin_min, 0.0);
  EXPECT_FALSE(std::signbit(run.metrics().friction_margin_min));
}

TEST(Evaluator, TheMarginOfLoadedFeetNeedsTheRobotsMass) {
  HandMadeRun run({.control_period = kPeriod, .terrain_height = {}, .hip_in_base = {}});
  run.step();
  EXPECT_TRUE(std::isnan(run.metrics().friction_margin_loaded_min));
}

TEST(Evaluator, FeetThatAreTakenBackAreCounted) {
  HandMadeRun run;
  for (const PlanEvent event : {PlanEvent::none, PlanEvent::no_ground, PlanEvent::late,
                                PlanEvent::touchdown, PlanEvent::no_ground}) {
    run.tick.plan.events = {};
    run.tick.plan.events.add({.kind = event});
    run.step();
  }
  EXPECT_EQ(run.metrics().no_ground_events, 2);
}

TEST(Evaluator, SlipIsThePathWithinOneStance) {
  HandMadeRun run;
  const auto stance = [&run](double metres) {
    run.phase(Leg::RF, LegPhase::stance);
    run.contact(Leg::RF).slip_velocity = {0.0, metres / (10 * kPeriod), 0.0};
    run.steps(5);
    run.contact(Leg::RF).slip_velocity *= -1.0;  // back again: the path counts
    run.steps(5);
  };
  stance(0.003);
  run.phase(Leg::RF, LegPhase::swing);
  run.steps(10);  // moves through the air
  stance(0.004);
  EXPECT_NEAR(run.metrics().foot_slip_max_m, 0.004, 1e-12);
}

TEST(Evaluator, StepsAreSwingsThatEndInStance) {
  HandMadeRun run;
  for (const LegPhase phase : {LegPhase::unloading, LegPhase::swing, LegPhase::search,
                               LegPhase::stance, LegPhase::unloading, LegPhase::swing}) {
    run.phase(Leg::LF, phase);
    run.steps(3);
  }
  EXPECT_EQ(run.metrics().steps_taken, 1);
}

TEST(Evaluator, SearchIsTheLongestOfAnyFootWithoutABreak) {
  HandMadeRun run;
  const auto search = [&run](int ticks) {
    run.phase(Leg::LF, LegPhase::search);
    run.steps(ticks);
    run.phase(Leg::LF, LegPhase::stance);
    run.step();
  };
  search(40);
  search(100);
  search(60);
  EXPECT_NEAR(run.metrics().search_max_s, 0.25, 1e-12);
}

TEST(Evaluator, EdgeLandingsAreJudgedOnceWhenTheFootIsFirstLoaded) {
  HandMadeRun run({.control_period = kPeriod,
                   .terrain_height = [](double x, double) { return x < 1.0 ? 0.0 : -0.14; },
                   .hip_in_base = {}});
  simulation::TrueContact& contact = run.contact(Leg::RF);
  contact.point = {0.995, 0.0, 0.0};  // stands on the edge from the beginning: not a landing
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 0);
  run.phase(Leg::RF, LegPhase::swing);
  run.step();
  run.phase(Leg::RF, LegPhase::stance);
  contact.force = Vec3::Zero();
  run.step();  // touches, but nothing rests on it yet
  EXPECT_EQ(run.metrics().edge_landings, 0);
  contact.force = {0.0, 0.0, 30.0};
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 1);
  run.phase(Leg::RF, LegPhase::swing);
  run.step();
  contact.point = {0.95, 0.0, 0.0};
  run.phase(Leg::RF, LegPhase::stance);
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 1);
  EXPECT_EQ(run.metrics().steps_taken, 2);
}

TEST(Evaluator, LimbExtensionIsFromTheTrueHipToTheTrueFoot) {
  HandMadeRun run(
      {.control_period = kPeriod, .terrain_height = {}, .hip_in_base = [](Leg leg, const Vec3& q) {
         return Vec3(leg == Leg::RH ? q[2] : 0.0, 0.0, 0.0);
       }});
  run.truth.p_SB = {1.0, 2.0, 0.45};
  run.truth.q_SB = Quat(Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()));
  run.truth.q[first_joint(Leg::RH) + 2] = 0.3;  // the hip 0.3 m along B's x, which is W's y
  for (Vec3& p_SF : run.truth.p_SF) p_SF = {1.0, 2.0, 0.05};
  run.step();
  EXPECT_NEAR(run.metrics().limb_extension_max_m, 0.5, 1e-12);
}

TEST(Evaluator, PenetrationIsTheDeepestOfAnyFoot) {
  HandMadeRun run;
  run.contact(Leg::LH).penetration = 0.002;
  run.step();
  run.contact(Leg::LH).penetration = 0.0;
  run.step();
  EXPECT_EQ(run.metrics().penetration_max_m, 0.002);
}

}  // namespace
}  // namespace surefoot::evaluation
