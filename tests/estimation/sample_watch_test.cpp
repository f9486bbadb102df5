#include "surefoot/estimation/sample_watch.hpp"

#include <gtest/gtest.h>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;   // [s]
constexpr double kPatience = 0.02;   // [s]
constexpr double kMaxDelay = 0.006;  // [s]

/// A sensor with a sample every `every` ticks that is `delay` ticks old when it comes.
struct Sensor {
  void tick() {
    ++ticks;
    if (ticks % every == 0) sample = kPeriod * (ticks - delay);
    watch.update(kPeriod * ticks, sample);
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  SampleWatch watch{kPeriod, kPatience, kMaxDelay};
  int every = 1, delay = 0, ticks = 0;
  double sample = 0.0;
};

TEST(SampleWatch, WhatIsBelievedLagsByTheSamplesAgeAndByNoMoreWhereTheyStop) {
  for (const int delay : {0, 1, 2}) {
    Sensor sensor;
    sensor.delay = delay;
    sensor.run(40);
    EXPECT_NEAR(sensor.watch.lag(), delay * kPeriod, 1e-12);
    sensor.every = 1'000'000;
    sensor.run(6);
    EXPECT_EQ(sensor.watch.fault(), SampleFault::silent);
    EXPECT_NEAR(sensor.watch.lag(), delay * kPeriod, 1e-12) << "what is filled in goes on";
  }
  Sensor slow;
  slow.every = 2;
  slow.run(40);
  EXPECT_NEAR(slow.watch.lag(), 0.0, 1e-12);
  slow.tick();
  EXPECT_NEAR(slow.watch.lag(), kPeriod, 1e-12) << "what is held does not";
}

// Only the first sample exists until the second arrives.
TEST(SampleWatch, OfASensorThatIsLateTheFirstSampleIsNotHeld) {
  Sensor sensor;
  sensor.delay = 1;
  sensor.watch.update(0.0, 0.0);
  sensor.tick();
  EXPECT_FALSE(sensor.watch.is_held());
  EXPECT_NEAR(sensor.watch.delay(), kPeriod, 1e-12);
}

TEST(SampleWatch, ASensorThatFallsSilentIsToldSoonIfItWasQuick) {
  for (const int every : {1, 2, 4}) {
    Sensor sensor;
    sensor.every = every;
    sensor.run(400);  // a multiple of each
    for (int since = 1; since < every; ++since) {
      sensor.tick();
      EXPECT_EQ(sensor.watch.fault(), SampleFault::none) << every << ", " << since;
    }
    sensor.every = 1'000'000;
    sensor.tick();
    EXPECT_EQ(sensor.watch.fault(), SampleFault::silent) << every;
    EXPECT_FALSE(sensor.watch.is_new());
  }
}

TEST(SampleWatch, WhatIsUsualIsLearntAndAtFirstAnythingIsThatIsWithinPatience) {
  Sensor sensor;
  sensor.every = 7;
  sensor.run(6);  // nothing yet but the time 0 that was given from the beginning
  EXPECT_EQ(sensor.watch.fault(), SampleFault::none);
  Sensor quick;
  quick.run(200);
  quick.every = 7;
  quick.run(2);
  EXPECT_EQ(quick.watch.fault(), SampleFault::silent) << "not usual for this one";
}

TEST(SampleWatch, NoSampleIsUsualThatIsOlderThanPatience) {
  Sensor sensor;
  sensor.every = 12;  // 30 ms
  for (int i = 0; i < 2000; ++i) {
    sensor.tick();
    const double age = kPeriod * sensor.ticks - sensor.sample;
    EXPECT_TRUE(age < kPatience + 1e-6 || sensor.watch.fault() == SampleFault::silent) << i;
  }
}

TEST(SampleWatch, TellsForHowLongNewSamplesComeLate) {
  Sensor sensor;
  sensor.delay = 2;  // 5 ms
  sensor.run(100);
  EXPECT_EQ(sensor.watch.delayed_for(), 0.0);
  sensor.delay = 3;  // 7.5 ms
  sensor.run(100);
  EXPECT_NEAR(sensor.watch.delayed_for(), 99 * kPeriod, 1e-9) << "one tick had no new sample";
  EXPECT_EQ(sensor.watch.fault(), SampleFault::none);
  sensor.delay = 2;
  sensor.tick();
  EXPECT_EQ(sensor.watch.delayed_for(), 0.0);
}

TEST(SampleWatch, FollowsADelayThatLasts) {
  Sensor sensor;
  sensor.delay = 1;
  sensor.run(100);
  EXPECT_TRUE(sensor.watch.is_punctual());
  sensor.delay = 2;
  sensor.tick();
  EXPECT_FALSE(sensor.watch.is_punctual()) << "it was there before";
  for (int i = 1; i <= 3; ++i) {
    sensor.tick();
    EXPECT_FALSE(sensor.watch.is_punctual()) << i;
    EXPECT_NEAR(sensor.watch.delay(), kPeriod, 1e-9) << i;
  }
  sensor.tick();
  EXPECT_TRUE(sensor.watch.is_punctual());
  EXPECT_NEAR(sensor.watch.delay(), 2.0 * kPeriod, 1e-9);
}

TEST(SampleWatch, FollowsNoDelayThatChanges) {
  Sensor sensor;
  sensor.run(100);
  for (int i = 0; i < 100; ++i) {
    sensor.delay = i % 5 < 2 ? 1 : 0;  // the first of the two was there before
    sensor.tick();
    EXPECT_EQ(sensor.watch.is_punctual(), sensor.delay == 0) << i;
    EXPECT_NEAR(sensor.watch.delay(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::estimation
