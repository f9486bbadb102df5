#include "surefoot/evaluation/touchdown_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

constexpr PerLeg<double> kSides{0.2, -0.2, 0.2, -0.2};

simulation::GroundTruth standing() {
  simulation::GroundTruth truth;
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    truth.p_SF[k] = Vec3(k < 2 ? 0.3 : -0.3, kSides[k], 0.03);
    truth.feet[k].touching = truth.feet[k].touched = true;
  }
  return truth;
}

/// A foot that swings; each tick says whether it touches and whether the plan lets it stand.
struct Steps {
  void tick(bool touching, bool stands) {
    truth.feet[0].touching = truth.feet[0].touched = touching;
    plan.feet[0].phase = stands ? LegPhase::stance : LegPhase::search;
    judge.add(truth, plan);
    truth.time += 0.0025;
  }
  void ticks(int count, bool touching, bool stands) {
    for (int i = 0; i < count; ++i) tick(touching, stands);
  }
  [[nodiscard]] Metrics metrics() const {
    Metrics result;
    judge.write(result);
    return result;
  }
  simulation::GroundTruth truth = standing();
  MotionPlan plan;
  TouchdownJudge judge;
};

TEST(TouchdownJudge, LatencyRunsFromTheFirstTouch) {
  Steps steps;
  steps.ticks(40, true, true);
  steps.ticks(100, false, false);
  steps.ticks(3, true, false);
  steps.ticks(10, false, false);  // it bounces
  steps.ticks(2, true, false);
  steps.tick(true, true);
  EXPECT_NEAR(steps.metrics().touchdown_latency_p95_s, 15 * 0.0025, 1e-9);
  EXPECT_EQ(steps.metrics().touchdowns_noticed, 1);
  EXPECT_EQ(steps.metrics().touchdowns_late, 1);
  EXPECT_EQ(steps.metrics().false_touchdowns, 0);
}

TEST(TouchdownJudge, LateIsMoreThan30Milliseconds) {
  Steps steps;
  for (const int ticks : {12, 13, 5}) {  // of 2.5 ms
    steps.ticks(100, false, false);
    steps.ticks(ticks, true, false);
    steps.ticks(40, true, true);
  }
  EXPECT_EQ(steps.metrics().touchdowns_noticed, 3);
  EXPECT_EQ(steps.metrics().touchdowns_late, 1);
}

TEST(TouchdownJudge, AFootInTheAirThatIsBelievedToStandIsAFalseTouchdown) {
  Steps steps;
  steps.ticks(40, true, true);
  steps.ticks(100, false, false);
  steps.tick(false, true);
  EXPECT_EQ(steps.metrics().false_touchdowns, 1);
  EXPECT_EQ(steps.metrics().touchdowns_noticed, 0);
  EXPECT_TRUE(std::isnan(steps.metrics().touchdown_latency_p95_s));
}

TEST(TouchdownJudge, ATouchThatWasOverBeforeTheTickIsOne) {
  Steps steps;
  steps.ticks(40, true, true);
  steps.ticks(100, false, false);
  steps.truth.feet[0].touched = true;
  steps.judge.add(steps.truth, steps.plan);
  steps.truth.time += 0.0025;
  steps.ticks(3, false, false);
  steps.tick(false, true);
  EXPECT_EQ(steps.metrics().false_touchdowns, 0);
}

TEST(TouchdownJudge, ATouchThatWasOverForMoreThan20MillisecondsIsNone) {
  Steps steps;
  for (const int ticks : {5, 12}) {  // of 2.5 ms
    steps.ticks(100, false, false);
    steps.tick(true, false);
    steps.ticks(ticks, false, false);
    steps.ticks(1, false, true);
    steps.ticks(40, true, true);
  }
  EXPECT_EQ(steps.metrics().touchdowns_noticed, 1);
  EXPECT_EQ(steps.metrics().false_touchdowns, 1);
}

TEST(TouchdownJudge, ATouchEarlierInTheSwingDoesNotCount) {
  Steps steps;
  steps.ticks(40, true, true);
  steps.ticks(50, false, false);
  steps.ticks(4, true, false);  // stumbles
  steps.ticks(100, false, false);
  steps.tick(true, false);
  steps.tick(true, true);
  EXPECT_NEAR(steps.metrics().touchdown_latency_p95_s, 0.0025, 1e-9);
}

TEST(TouchdownJudge, ALargerRobotsBouncesMayBeLonger) {
  for (const double length : {1.0, 4.0}) {
    Steps steps;
    steps.judge = TouchdownJudge(Scale{.length = length});
    steps.ticks(40, true, true);
    steps.ticks(100, false, false);
    steps.tick(true, false);
    steps.ticks(29, false, false);  // 75 ms
    steps.tick(true, true);
    EXPECT_NEAR(steps.metrics().touchdown_latency_p95_s, length > 1.0 ? 30 * 0.0025 : 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace surefoot::evaluation
