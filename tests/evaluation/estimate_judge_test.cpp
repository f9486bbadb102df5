#include "surefoot/evaluation/estimate_judge.hpp"

#include "surefoot/evaluation/touchdown_judge.hpp"
#include "surefoot/math/rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr PerLeg<double> kSides{0.2, -0.2, 0.2, -0.2};

GroundTruth standing() {
  GroundTruth truth;
  for (std::size_t k = 0; k < kNumLegs; ++k) {
    truth.p_WF[k] = Vec3(k < 2 ? 0.3 : -0.3, kSides[k], 0.03);
    truth.feet[k].touching = truth.feet[k].touched = true;
  }
  return truth;
}

TEST(EstimateJudge, HeadingAndPositionOfTheStartAreNoError) {
  GroundTruth truth;
  RobotState state;
  const Quat turned = from_roll_pitch_yaw({0.0, 0.0, 1.1});
  EstimateJudge judge;
  for (int tick = 0; tick < 10; ++tick) {
    truth.p_WB = Vec3(0.1 * tick, 0.02 * tick, 0.4);
    truth.v_WB = Vec3(0.1, 0.02, 0.0);
    state.p_WB = turned * truth.p_WB + Vec3(5.0, 6.0, 7.0);
    state.v_WB = turned * truth.v_WB;
    state.q_WB = turned * truth.q_WB;
    judge.add(truth, state);
  }
  Metrics metrics;
  judge.write(metrics);
  EXPECT_LT(metrics.velocity_error_rms_mps, 1e-12);
  EXPECT_LT(metrics.tilt_error_max_rad, 1e-9);
  EXPECT_LT(metrics.position_drift_m, 1e-9);
  EXPECT_LT(metrics.heading_drift_rad, 1e-9);
}

TEST(EstimateJudge, MeasuresVelocityTiltAndDrift) {
  GroundTruth truth;
  RobotState state;
  state.p_WB.setZero();
  state.v_WB = Vec3(0.003, 0.004, 0.0);
  state.q_WB = Quat::Identity();
  EstimateJudge judge;
  judge.add(truth, state);
  state.p_WB = Vec3(0.0, 0.03, 0.04);
  state.q_WB = from_roll_pitch_yaw({0.02, 0.0, 0.3});
  state.v_WB.setZero();
  judge.add(truth, state);
  Metrics metrics;
  judge.write(metrics);
  EXPECT_NEAR(metrics.velocity_error_rms_mps, 0.005 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(metrics.tilt_error_max_rad, 0.02, 1e-12);
  EXPECT_NEAR(metrics.tilt_error_rms_rad, 0.02 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(metrics.position_drift_m, 0.05, 1e-12);
  EXPECT_NEAR(metrics.heading_drift_rad, 0.3, 1e-9);
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
  GroundTruth truth = standing();
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

}  // namespace
}  // namespace surefoot
