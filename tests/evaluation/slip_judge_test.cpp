#include "surefoot/evaluation/slip_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr double kPeriod = 0.0025;

struct Slide {
  Slide() {
    for (simulation::TrueContact& foot : truth.feet) {
      foot.touching = true;
      foot.force = Vec3(0.0, 0.0, 75.0);
    }
  }
  void ticks(int count, double speed, bool believed) {
    truth.feet[2].slip_velocity = Vec3(0.0, speed, 0.0);
    tick.state.slips[2] = believed;
    for (int i = 0; i < count; ++i) {
      judge.add(truth, tick);
      truth.time += kPeriod;
    }
  }
  [[nodiscard]] Metrics metrics() const {
    Metrics result;
    judge.write(result);
    return result;
  }
  simulation::GroundTruth truth;
  TickRecord tick;
  SlipJudge judge{kPeriod};
};

TEST(SlipJudge, LatencyRunsFromTheBeginningOfTheSlide) {
  Slide slide;
  slide.ticks(10, 0.0, false);
  slide.ticks(6, 0.2, false);
  slide.ticks(4, 0.2, true);
  slide.ticks(40, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_detected, 1);
  EXPECT_EQ(slide.metrics().slips_missed, 0);
  EXPECT_EQ(slide.metrics().slips_false, 0);
  EXPECT_NEAR(slide.metrics().slip_latency_p95_s, 6 * kPeriod, 1e-9);
}

TEST(SlipJudge, ASlideThatNobodyNoticesIsMissed) {
  Slide slide;
  slide.ticks(20, 0.1, false);
  slide.ticks(40, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_missed, 1);
  EXPECT_EQ(slide.metrics().slips_detected, 0);
  EXPECT_TRUE(std::isnan(slide.metrics().slip_latency_p95_s));
}

TEST(SlipJudge, AShortSlowOrLightOneIsNone) {
  Slide slide;
  slide.ticks(3, 0.2, false);
  slide.ticks(40, 0.0, false);
  slide.ticks(100, 0.04, false);
  slide.truth.feet[2].force.z() = 10.0;
  slide.ticks(100, 0.5, false);
  slide.ticks(40, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_missed, 0);
}

TEST(SlipJudge, WhatIsBelievedOfAFootThatRestsIsFalse) {
  Slide slide;
  slide.ticks(40, 0.0, false);
  slide.ticks(10, 0.0, true);
  EXPECT_EQ(slide.metrics().slips_false, 1);
  EXPECT_EQ(slide.metrics().slips_detected, 0);
}

TEST(SlipJudge, ASlideThatGoesOnToTheEndCountsToo) {
  Slide missed, noticed;
  missed.ticks(20, 0.1, false);
  EXPECT_EQ(missed.metrics().slips_missed, 1);
  noticed.ticks(20, 0.1, true);
  EXPECT_EQ(noticed.metrics().slips_detected, 1);
  EXPECT_EQ(noticed.metrics().slips_missed, 0);
}

TEST(SlipJudge, SlowerSlidesOfLighterFeetCountForASmallRobot) {
  Slide slide;
  slide.judge = SlipJudge(kPeriod, {.length = 0.25, .mass = 0.1});
  slide.truth.feet[2].force.z() = 10.0;
  slide.ticks(20, 0.04, false);
  slide.ticks(40, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_missed, 1);
}

TEST(SlipJudge, ALargerRobotsSlipsTakeLonger) {
  Slide slide;
  slide.judge = SlipJudge(kPeriod, Scale{.length = 4.0});
  slide.ticks(6, 0.2, false);  // 15 ms
  slide.ticks(100, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_missed, 0);
  slide.ticks(10, 0.2, false);
  slide.ticks(100, 0.0, false);
  EXPECT_EQ(slide.metrics().slips_missed, 1);
}

}  // namespace
}  // namespace surefoot::evaluation
