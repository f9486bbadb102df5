#include "tests/gaits/puppet.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::gaits {
namespace {

PlannerOptions trot() {
  PlannerOptions options;
  options.rhythm.enabled = true;
  options.force.ramp_up = options.force.ramp_down = 0.02;
  options.reflex.enabled = false;
  options.swing.horizontal_start = 0.0;
  options.swing.horizontal_end = 1.0;
  return options;
}

TEST(RhythmicGait, MovesDiagonalPairsInTurn) {
  test::Puppet puppet(trot());
  puppet.user = {.walk = true, .velocity = {0.3, 0.0}};
  int fewest = 4;
  puppet.run(5.0, [&] {
    const MotionPlan& plan = puppet.plan();
    fewest = std::min(fewest, plan.num_contacts());
    const bool first = plan.contact(Leg::LF) && plan.contact(Leg::RH);
    const bool second = plan.contact(Leg::RF) && plan.contact(Leg::LH);
    EXPECT_TRUE(first || second) << puppet.time();
  });
  EXPECT_EQ(fewest, 2);
  EXPECT_GT(puppet.happenings(PlanEvent::lift_off).size(), 30u);
  EXPECT_NEAR(puppet.plan().com.v.x(), 0.3, 1e-9);
}

TEST(RhythmicGait, WaitsForAFootThatFindsNoGround) {
  test::Puppet puppet(trot());
  puppet.user.walk = true;
  puppet.run(2.0);
  const std::size_t before = puppet.happenings(PlanEvent::lift_off).size();
  puppet.ground = [](const Vec2& p) { return p.x() > 0.0 && p.y() > 0.0 ? -0.5 : 0.0; };
  puppet.run(0.35);
  const std::size_t lifted = puppet.happenings(PlanEvent::lift_off).size() - before;
  EXPECT_LE(lifted, 4u) << "without waiting";
}

TEST(RhythmicGait, PutsFeetDownAgainThatReliedOnOneThatFlewOff) {
  test::Puppet puppet(trot());
  puppet.user.walk = true;
  puppet.run(2.0);
  const auto until = [&](const auto& holds) {
    for (int i = 0; i < 400 && !holds(); ++i) puppet.tick();
  };
  const auto down = [&](Leg k) { return puppet.plan().contact(k); };
  until([&] { return !down(Leg::LF) || !down(Leg::RF); });
  const Leg lands = down(Leg::LF) ? Leg::RF : Leg::LF, relies = down(Leg::LF) ? Leg::LF : Leg::RF;
  until([&] { return down(lands); });
  until([&] { return !down(relies); });
  puppet.run(0.02);
  puppet.fling(lands, Vec3(0.0, 0.0, -0.03), Vec3(0.0, 0.0, -1.0));
  puppet.tick();
  EXPECT_EQ(puppet.plan().feet[index(lands)].phase, LegPhase::search);
  EXPECT_EQ(puppet.plan().feet[index(relies)].phase, LegPhase::search);
  test::Puppet finds_none = puppet;
  finds_none.ground = [](const Vec2&) { return -0.5; };
  finds_none.run(0.1);
  EXPECT_EQ(finds_none.happenings(PlanEvent::lift_off).size(),
            puppet.happenings(PlanEvent::lift_off).size())
      << "lifts feet that search";
  puppet.fling(lands, Vec3::Zero(), Vec3::Zero());  // it has come to rest
  until([&] { return down(lands) && down(relies); });
  EXPECT_TRUE(down(lands) && down(relies));
}

TEST(RhythmicGait, RisesHigherAndCrouchesWhereItIsSlow) {
  PlannerOptions options = trot();
  options.rhythm.rise = 0.05;
  options.rhythm.crouch = 0.04;
  test::Puppet puppet(options);
  const auto highest = [&](double velocity) {
    puppet.user = {.walk = true, .velocity = {velocity, 0.0}};
    puppet.run(3.0);
    double result = 0.0;
    puppet.run(1.0, [&] { result = std::max(result, puppet.foot(Leg::LF).z()); });
    return result;
  };
  const double low = options.swing.apex, standing = options.stance.height;
  EXPECT_NEAR(highest(0.4), low + 0.05, 0.005);
  EXPECT_NEAR(puppet.plan().torso.height, standing - 0.04, 0.002);
  EXPECT_NEAR(highest(1.0), low, 0.005);
  EXPECT_NEAR(puppet.plan().torso.height, standing, 0.002);
}

TEST(RhythmicGait, StandsAgainOnAllFeetOnceItIsSlow) {
  test::Puppet puppet(trot());
  puppet.user = {.walk = true, .velocity = {0.5, 0.0}};
  puppet.run(4.0);
  puppet.user = {};
  puppet.run(2.0);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  const std::size_t lifted = puppet.happenings(PlanEvent::lift_off).size();
  puppet.run(1.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::lift_off).size(), lifted);
  EXPECT_LT(puppet.plan().com.v.norm(), 0.01);
}

TEST(RhythmicGait, StepsOutwardWhereTheRobotIsPushed) {
  test::Puppet calm(trot()), pushed(trot());
  for (test::Puppet* puppet : {&calm, &pushed}) {
    puppet->user.walk = true;
    puppet->run(2.0);
  }
  pushed.blow = Vec2(0.0, 0.3);
  for (test::Puppet* puppet : {&calm, &pushed}) puppet->run(0.3);
  const double aside = pushed.foot(Leg::LF).y() - calm.foot(Leg::LF).y();
  EXPECT_GT(aside, 0.02);
}

}  // namespace
}  // namespace surefoot::gaits
