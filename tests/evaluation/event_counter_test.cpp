#include "surefoot/evaluation/event_counter.hpp"

#include <gtest/gtest.h>

namespace surefoot::evaluation {
namespace {

/// Counts one event a tick.
class Events {
 public:
  void add(double time, PlanEvent kind, std::optional<Leg> leg = {}) {
    EventList events;
    events.add({.kind = kind, .leg = leg});
    events_.add(time, events);
  }
  [[nodiscard]] const std::vector<EventCount>& counts() const { return events_.counts(); }

 private:
  EventCounter events_;
};

TEST(EventCounter, tells_leg_count_and_first_time_of_a_foot_that_found_no_ground) {
  Events events;
  for (const double time : {1.0, 4.0, 9.5}) {
    events.add(time - 0.1, PlanEvent::none);
    events.add(time, PlanEvent::no_ground, Leg::LH);
  }
  ASSERT_EQ(events.counts().size(), 1u);
  EXPECT_EQ(events.counts()[0].event, PlanEvent::no_ground);
  EXPECT_EQ(events.counts()[0].leg, Leg::LH);
  EXPECT_EQ(events.counts()[0].count, 3);
  EXPECT_EQ(events.counts()[0].first, 1.0);
}

TEST(EventCounter, counts_all_events_of_a_tick) {
  EventList both;
  both.add({.kind = PlanEvent::slip, .leg = Leg::RF});
  both.add({.kind = PlanEvent::slip, .leg = Leg::LH});
  EventCounter events;
  events.add(1.0, both);
  ASSERT_EQ(events.counts().size(), 2u);
  EXPECT_EQ(events.counts()[0].leg, Leg::RF);
  EXPECT_EQ(events.counts()[1].leg, Leg::LH);
}

TEST(EventCounter, of_an_event_of_no_leg_names_none) {
  Events events;
  const auto unknown_here = static_cast<PlanEvent>(1000);
  events.add(1.0, unknown_here);
  ASSERT_EQ(events.counts().size(), 1u);
  EXPECT_EQ(events.counts()[0].leg, std::nullopt);
}

TEST(EventCounter, counts_the_legs_apart_and_leaves_the_usual_steps_out) {
  Events events;
  events.add(1.0, PlanEvent::lift_off, Leg::LF);
  events.add(2.0, PlanEvent::late, Leg::LF);
  events.add(3.0, PlanEvent::touchdown, Leg::LF);
  events.add(4.0, PlanEvent::late, Leg::RF);
  events.add(5.0, PlanEvent::probe_same_ground, Leg::RF);
  ASSERT_EQ(events.counts().size(), 2u);
  EXPECT_EQ(events.counts()[0].leg, Leg::LF);
  EXPECT_EQ(events.counts()[1].leg, Leg::RF);
}

}  // namespace
}  // namespace surefoot::evaluation
