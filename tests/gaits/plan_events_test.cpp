#include "tests/gaits/watch.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

TEST(PlanEvents, TwoFeetThatBeginToSlideAtOneTickAreBothTold) {
  test::Puppet puppet;
  puppet.run(0.5);
  puppet.slide[index(Leg::RF)] = puppet.slide[index(Leg::LH)] = Vec2(30.0, 0.0);
  puppet.tick();
  const EventList& events = puppet.plan().events;
  ASSERT_EQ(events.count, 2u);
  EXPECT_EQ(events.items[0].kind, PlanEvent::slip);
  EXPECT_EQ(events.items[0].leg, Leg::RF);
  EXPECT_EQ(events.items[1].kind, PlanEvent::slip);
  EXPECT_EQ(events.items[1].leg, Leg::LH);
}

TEST(PlanEvents, EveryEventOfAFootHasItsLegPlaceAndForce) {
  test::Puppet puppet = test::walker(test::probing(), test::step_at(0.40, -0.10));
  int told = 0;
  puppet.run(30.0, [&] {
    for (const GaitEvent& event : puppet.plan().events) {
      ++told;
      ASSERT_TRUE(event.leg) << name(event.kind);
      EXPECT_EQ(event.place, puppet.foot(*event.leg)) << name(event.kind);
      EXPECT_NEAR(event.force, puppet.force(*event.leg).z(), 2.0) << name(event.kind);
    }
  });
  EXPECT_GT(told, 40);
}

TEST(PlanEvents, APushIsToldWithItsForce) {
  test::Puppet puppet = test::walker();
  int ticks = 0;  // of LF in the air
  while (ticks < 40 && puppet.time() < 20.0) {
    puppet.tick();
    ticks = puppet.plan().contact(Leg::LF) ? 0 : ticks + 1;
  }
  puppet.push = Vec3(60.0, 110.0, 0.0);  // tips it over this foot
  puppet.tick();
  const EventList& events = puppet.plan().events;
  const auto told = std::ranges::find(events, PlanEvent::push_foot_down, &GaitEvent::kind);
  ASSERT_NE(told, events.end());
  EXPECT_EQ(told->leg, Leg::LF);
  EXPECT_NEAR(told->force, puppet.push.norm(), 1e-9);
}

TEST(EventLists, KeepTheOrderAndLeaveOutWhatIsTooMuch) {
  EventList events;
  events.add({.kind = PlanEvent::none});
  EXPECT_TRUE(events.empty());
  for (int i = 0; i < 20; ++i) events.add({.kind = i == 0 ? PlanEvent::late : PlanEvent::slip});
  EXPECT_EQ(events.count, EventList::kMost);
  EXPECT_EQ(events.begin()->kind, PlanEvent::late);
  EXPECT_FALSE(events.has(PlanEvent::touchdown));
}

}  // namespace
}  // namespace surefoot::gaits
