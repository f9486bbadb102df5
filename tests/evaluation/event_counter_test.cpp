#include "surefoot/evaluation/event_counter.hpp"

#include <gtest/gtest.h>

namespace surefoot {
namespace {

MotionPlan plan_of(const PerLeg<LegPhase>& phases, PlanEvent event = PlanEvent::none) {
  MotionPlan plan;
  for (const Leg leg : kLegs) plan.feet[index(leg)].phase = phases[index(leg)];
  plan.event = static_cast<int>(event);
  return plan;
}

/// The notable events of ticks at which no foot slides.
class Events {
 public:
  void add(double time, const MotionPlan& plan) { events_.add(time, plan, RobotState()); }
  [[nodiscard]] const std::vector<EventCount>& counts() const { return events_.counts(); }

 private:
  EventCounter events_;
};

constexpr LegPhase kStance = LegPhase::stance, kUnloading = LegPhase::unloading,
                   kSwing = LegPhase::swing, kSearch = LegPhase::search;

TEST(EventCounter, tells_leg_count_and_first_time_of_a_foot_that_found_no_ground) {
  Events events;
  for (const double time : {1.0, 4.0, 9.5}) {
    events.add(time - 0.1, plan_of({kStance, kStance, kSearch, kStance}));
    events.add(time, plan_of({kStance, kStance, kSwing, kStance}, PlanEvent::no_ground));
  }
  ASSERT_EQ(events.counts().size(), 1u);
  EXPECT_EQ(events.counts()[0].event, PlanEvent::no_ground);
  EXPECT_EQ(events.counts()[0].leg, Leg::LH);
  EXPECT_EQ(events.counts()[0].count, 3);
  EXPECT_EQ(events.counts()[0].first, 1.0);
}

TEST(EventCounter, of_several_legs_in_the_air_takes_the_one_that_it_happened_to) {
  Events events;
  events.add(0.0, plan_of({kSearch, kStance, kStance, kUnloading}));
  events.add(1.0, plan_of({kSearch, kSearch, kStance, kStance}, PlanEvent::lost_contact));
  events.add(2.0, plan_of({kSearch, kSwing, kStance, kStance}, PlanEvent::no_ground));
  events.add(3.0, plan_of({kSearch, kStance, kStance, kUnloading}));
  events.add(4.0, plan_of({kSearch, kStance, kStance, kStance}, PlanEvent::lift_off_aborted));
  ASSERT_EQ(events.counts().size(), 3u);
  EXPECT_EQ(events.counts()[0].leg, Leg::RF);
  EXPECT_EQ(events.counts()[1].leg, Leg::RF);
  EXPECT_EQ(events.counts()[2].leg, Leg::RH);
}

TEST(EventCounter, every_event_of_one_foot_names_it_and_those_of_the_robot_name_none) {
  const auto legs = [](LegPhase last) {
    return LegsAtTick{.phases = {kStance, kStance, kStance, last}};
  };
  const LegsAtTick stand = legs(kStance), unloads = legs(kUnloading), swings = legs(kSwing),
                   searches = legs(kSearch);
  EXPECT_EQ(leg_of(PlanEvent::lift_off, unloads, swings), Leg::RH);
  EXPECT_EQ(leg_of(PlanEvent::push_step, stand, swings), Leg::RH);
  EXPECT_EQ(leg_of(PlanEvent::push_reloaded, unloads, stand), Leg::RH);
  EXPECT_EQ(leg_of(PlanEvent::lost_contact, stand, searches), Leg::RH);
  EXPECT_EQ(leg_of(PlanEvent::touchdown, searches, stand), Leg::RH);
  for (const PlanEvent event :
       {PlanEvent::probe_same_ground, PlanEvent::probe_edge, PlanEvent::late, PlanEvent::no_ground,
        PlanEvent::collision, PlanEvent::caught, PlanEvent::push_foot_down}) {
    EXPECT_EQ(leg_of(event, swings, swings), Leg::RH) << name(event);
  }
  for (const PlanEvent event :
       {PlanEvent::slowed, PlanEvent::slip, PlanEvent::support_widened, PlanEvent::lowered})
    EXPECT_EQ(leg_of(event, swings, stand), std::nullopt) << name(event);
}

TEST(EventCounter, names_the_foot_that_began_to_slide_where_it_is_one) {
  EventCounter events;
  RobotState state;
  const auto add = [&](double time, PerLeg<bool> slips) {
    state.slips = slips;
    events.add(time, plan_of({kStance, kStance, kStance, kStance}, PlanEvent::slip), state);
    return events.counts().back().leg;
  };
  EXPECT_EQ(add(1.0, {true, false, false, false}), Leg::LF);
  EXPECT_EQ(add(2.0, {true, false, true, false}), Leg::LH) << "LF slides on";
  EXPECT_EQ(add(3.0, {false, true, false, true}), std::nullopt) << "two at once";
}

TEST(EventCounter, of_an_event_of_no_leg_names_none) {
  Events events;
  const auto unknown_here = static_cast<PlanEvent>(1000);
  events.add(1.0, plan_of({kStance, kSwing, kStance, kStance}, unknown_here));
  ASSERT_EQ(events.counts().size(), 1u);
  EXPECT_EQ(events.counts()[0].leg, std::nullopt);
}

TEST(EventCounter, counts_the_legs_apart_and_leaves_the_usual_steps_out) {
  Events events;
  events.add(1.0, plan_of({kSwing, kStance, kStance, kStance}, PlanEvent::lift_off));
  events.add(2.0, plan_of({kSearch, kStance, kStance, kStance}, PlanEvent::late));
  events.add(3.0, plan_of({kStance, kStance, kStance, kStance}, PlanEvent::touchdown));
  events.add(4.0, plan_of({kStance, kSearch, kStance, kStance}, PlanEvent::late));
  events.add(5.0, plan_of({kStance, kSwing, kStance, kStance}, PlanEvent::probe_same_ground));
  ASSERT_EQ(events.counts().size(), 2u);
  EXPECT_EQ(events.counts()[0].leg, Leg::LF);
  EXPECT_EQ(events.counts()[1].leg, Leg::RF);
}

}  // namespace
}  // namespace surefoot
