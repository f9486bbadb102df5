#include "surefoot/gaits/rhythm/phase_clock.hpp"

#include "surefoot/signals/per_leg.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kTick = 0.0025;

RhythmOptions trot() { return {.enabled = true, .period = 0.5, .duty = per_leg(0.6)}; }

TEST(PhaseClock, lets_each_leg_lift_off_once_in_a_cycle_and_pairs_together) {
  PhaseClock clock(trot());
  clock.start(0.03, Leg::LF);
  PerLeg<int> lifts{};
  for (int i = 0; i < 2000; ++i) {
    clock.advance(kTick);
    for (const Leg k : kLegs) lifts[index(k)] += clock.lifts(k) ? 1 : 0;
    EXPECT_EQ(clock.lifts(Leg::LF), clock.lifts(Leg::RH));
    EXPECT_EQ(clock.lifts(Leg::RF), clock.lifts(Leg::LH));
    EXPECT_FALSE(clock.lifts(Leg::LF) && clock.lifts(Leg::RF));
  }
  for (const Leg k : kLegs) EXPECT_NEAR(lifts[index(k)], 10, 1);
}

TEST(PhaseClock, gives_each_leg_its_own_share_of_swing) {
  RhythmOptions options = trot();
  options.duty[index(Leg::RH)] = 0.75;
  PhaseClock clock(options);
  clock.start(0.0, Leg::LF);
  PerLeg<double> swung{};
  for (int i = 0; i < 2000; ++i) {
    clock.advance(kTick);
    for (const Leg k : kLegs) swung[index(k)] += clock.swings(k) ? kTick / 5.0 : 0.0;
  }
  EXPECT_NEAR(swung[index(Leg::LF)], 0.4, 0.01);
  EXPECT_NEAR(swung[index(Leg::RH)], 0.25, 0.01);
  EXPECT_DOUBLE_EQ(clock.swing_duration(Leg::RH), 0.125);
  EXPECT_DOUBLE_EQ(clock.stance_duration(Leg::LF), 0.3);
}

TEST(PhaseClock, starts_with_all_feet_down_for_the_time_asked) {
  PhaseClock clock(trot());
  clock.start(0.03, Leg::LF);
  EXPECT_NEAR(clock.until_lift_off(Leg::LF), 0.03, 1e-9);
  EXPECT_NEAR(clock.until_lift_off(Leg::RF), 0.28, 1e-9);
  EXPECT_LT(clock.until_landing(Leg::RF), 0.0);
  for (const Leg k : kLegs) EXPECT_FALSE(clock.swings(k));
}

TEST(PhaseClock, returns_to_a_landing_after_which_the_others_lift_off_once_more) {
  PhaseClock clock(trot());
  clock.start(0.001, Leg::LF);
  for (int i = 0; i < 120; ++i) clock.advance(kTick);  // 0.3 s: the others are in the air
  EXPECT_TRUE(clock.swings(Leg::RF));
  clock.return_to_landing(Leg::LF, 0.02);
  EXPECT_NEAR(clock.until_landing(Leg::LF), 0.02, 1e-9);
  EXPECT_FALSE(clock.lifts(Leg::RF));
  EXPECT_NEAR(clock.until_lift_off(Leg::RF), 0.02 + 0.05, 1e-9);
  int lifts = 0;
  for (int i = 0; i < 40; ++i) {
    clock.advance(kTick);
    lifts += clock.lifts(Leg::RF) ? 1 : 0;
  }
  EXPECT_EQ(lifts, 1);
}

TEST(PhaseClock, stands_still_without_time) {
  PhaseClock clock(trot());
  clock.start(0.001, Leg::LF);
  clock.advance(0.0);
  EXPECT_FALSE(clock.lifts(Leg::LF));
  EXPECT_NEAR(clock.until_lift_off(Leg::LF), 0.001, 1e-9);
}

}  // namespace
}  // namespace surefoot::gaits
