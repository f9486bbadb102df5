// Feet that must not lift off.
#include "tests/gaits/watch.hpp"

namespace surefoot::gaits {
namespace {

TEST(Planner, AFootThatDoesNotUnloadIsNotLifted) {
  test::Puppet puppet = test::walker();
  puppet.sticky[index(Leg::LH)] = true;
  test::run_watched(puppet, 12.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off).empty());
  EXPECT_GE(puppet.happenings(PlanEvent::lift_off_aborted).size(), 2u);
  EXPECT_EQ(puppet.plan().num_contacts(), 4);
  puppet.sticky = {};
  test::run_watched(puppet, 5.0);
  EXPECT_FALSE(puppet.happenings(PlanEvent::lift_off).empty()) << "and is when it does";
}

TEST(Planner, AFootThatIsAboutToLeaveStaysWhileAnotherSlides) {
  test::Puppet puppet = test::walker();
  const auto& hind = puppet.plan().feet[index(Leg::LH)];
  while (hind.phase != LegPhase::unloading && puppet.time() < 20.0) puppet.tick();
  ASSERT_EQ(hind.phase, LegPhase::unloading);
  const double begin = puppet.time();
  puppet.slide[index(Leg::RF)] = Vec2(30.0, 0.0);
  puppet.tick();
  puppet.slide.fill(Vec2::Zero());
  EXPECT_EQ(puppet.happenings().back().event, PlanEvent::slip);
  EXPECT_EQ(hind.phase, LegPhase::stance);
  const std::size_t lifts = puppet.happenings(PlanEvent::lift_off).size();
  while (puppet.happenings(PlanEvent::lift_off).size() == lifts && puppet.time() < begin + 10.0)
    puppet.tick();
  EXPECT_GE(puppet.time(), begin + GaitOptions{}.switch_duration - test::kPeriod);
  EXPECT_LT(puppet.time(), begin + 10.0) << "and then it goes";
}

/// A walk in which the torso's tilt is missed by `always`, and by `missed` more while the left hind
/// foot unloads and carries little [rad/s²].
test::Puppet weak_without_left_hind(double always, double missed, double duration) {
  test::Puppet puppet = test::walker();
  puppet.run(duration, [&] {
    const FootPlan& foot = puppet.plan().feet[index(Leg::LH)];
    const bool light = foot.phase == LegPhase::unloading && foot.force_max < 100.0;
    puppet.last.tilt_shortfall = always + (light ? missed : 0.0);
  });
  return puppet;
}

TEST(Planner, AFootWithoutWhichTheOthersLetTheTorsoGoIsLoadedAgain) {
  for (const double always : {0.0, 40.0}) {
    const test::Puppet puppet = weak_without_left_hind(always, 50.0, 12.0);
    EXPECT_GE(puppet.happenings(PlanEvent::lift_off_aborted).size(), 2u) << "again and again";
    for (const test::Happening& lift : puppet.happenings(PlanEvent::lift_off))
      EXPECT_NE(lift.leg, Leg::LH);
    EXPECT_EQ(puppet.plan().num_contacts(), 4);
  }
}

TEST(Planner, ATorsoThatIsNotWhereItShouldBeOnAllFeetEitherStopsNoLiftOff) {
  const test::Puppet puppet = weak_without_left_hind(60.0, 10.0, 12.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off_aborted).empty());
  EXPECT_GT(puppet.planner().steps_taken(), 4);
}

TEST(Planner, OfATiltThatIsNotKnownNoLiftOffIsTakenBack) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const test::Puppet before = weak_without_left_hind(kUnknown, 50.0, 6.0);
  EXPECT_TRUE(before.happenings(PlanEvent::lift_off_aborted).empty());
  const test::Puppet after = weak_without_left_hind(0.0, kUnknown, 6.0);
  EXPECT_TRUE(after.happenings(PlanEvent::lift_off_aborted).empty());
  EXPECT_GT(after.planner().steps_taken(), 0);
}

TEST(Planner, NoFootIsLiftedWhileTheBalanceIsNotOverTheOthers) {
  test::Puppet puppet = test::walker();
  puppet.com_follows = false;  // stays in the middle, which lies on the triangle's edge
  puppet.run(12.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::lift_off).empty());
  EXPECT_GE(puppet.happenings(PlanEvent::lift_off_aborted).size(), 2u);
}

}  // namespace
}  // namespace surefoot::gaits
