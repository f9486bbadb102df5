#include "surefoot/evaluation/estimate_judge.hpp"

#include "surefoot/math/rotation.hpp"
#include "surefoot/signals/plan_event.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

TEST(EstimateJudge, HeadingAndPositionOfTheStartAreNoError) {
  simulation::GroundTruth truth;
  RobotState state;
  const Quat turned = from_roll_pitch_yaw({0.0, 0.0, 1.1});
  EstimateJudge judge;
  for (int tick = 0; tick < 10; ++tick) {
    truth.p_SB = Vec3(0.1 * tick, 0.02 * tick, 0.4);
    truth.v_SB = Vec3(0.1, 0.02, 0.0);
    state.p_WB = turned * truth.p_SB + Vec3(5.0, 6.0, 7.0);
    state.v_WB = turned * truth.v_SB;
    state.q_WB = turned * truth.q_SB;
    judge.add(truth, state);
  }
  Metrics metrics;
  judge.write(metrics);
  EXPECT_LT(metrics.velocity_error_rms_mps, 1e-12);
  EXPECT_LT(metrics.tilt_error_max_rad, 1e-9);
  EXPECT_LT(metrics.position_drift_m, 1e-9);
  EXPECT_LT(metrics.heading_drift_rad, 1e-9);
}

TEST(EstimateJudge, OnlyAnEventSaysThatAnEstimateBeginsAnew) {
  TickRecord tick;
  EXPECT_FALSE(estimate_restarts(tick));
  tick.plan.events.add({.kind = PlanEvent::calibration});
  EXPECT_FALSE(estimate_restarts(tick));
  tick.plan.events.add({.kind = PlanEvent::begun_anew});
  EXPECT_TRUE(estimate_restarts(tick));
}

TEST(EstimateJudge, MeasuresVelocityTiltAndDrift) {
  simulation::GroundTruth truth;
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

// Of 2 σ in each direction, in base axes that W's axes are turned against; and of a tilt of 3 σ.
TEST(EstimateJudge, NeesComparesErrorsWithTheirBelievedVariance) {
  simulation::GroundTruth truth;
  RobotState state;
  state.p_WB.setZero();
  const Vec3 sigma(0.01, 0.02, 0.03);
  truth.v_SB = Vec3(1.0, 0.0, 0.0);
  state.q_WB = from_roll_pitch_yaw({0.0, 0.006, 0.8});
  const Vec3 v_B = truth.v_SB + 2.0 * sigma;
  state.v_WB = state.q_WB * v_B;
  state.velocity_covariance = sigma.cwiseAbs2().asDiagonal();
  // The tilt is about the base's y axis, which the heading turns.
  const Mat3 turn = from_roll_pitch_yaw({0.0, 0.0, 0.8}).toRotationMatrix();
  state.orientation_covariance = turn * Vec3(1e-8, 4e-6, 1.0).asDiagonal() * turn.transpose();
  EstimateJudge judge;
  judge.add(truth, state);
  Metrics metrics;
  judge.write(metrics);
  EXPECT_NEAR(metrics.velocity_nees, 4.0, 1e-9);
  EXPECT_NEAR(metrics.tilt_nees, 9.0 / 2.0, 1e-3);
}

TEST(EstimateJudge, AnEstimateWithoutCovarianceHasNoNees) {
  simulation::GroundTruth truth;
  RobotState state;
  state.p_WB = state.v_WB = Vec3::Zero();
  state.q_WB = Quat::Identity();
  EstimateJudge judge;
  judge.add(truth, state);
  Metrics metrics;
  judge.write(metrics);
  EXPECT_TRUE(std::isnan(metrics.velocity_nees));
  EXPECT_TRUE(std::isnan(metrics.tilt_nees));
}

}  // namespace
}  // namespace surefoot::evaluation
