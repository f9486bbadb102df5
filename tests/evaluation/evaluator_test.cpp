#include "tests/evaluation/hand_made_run.hpp"

#include <cmath>

namespace surefoot::evaluation {
namespace {

using test::HandMadeRun;

TEST(Evaluator, StandingStillIsFaultless) {
  HandMadeRun run;
  run.steps(400);
  const Metrics metrics = run.metrics();
  EXPECT_FALSE(metrics.fell);
  EXPECT_NE(metrics.succeeded, true) << "criteria decide";
  EXPECT_EQ(metrics.reason, "completed");
  EXPECT_DOUBLE_EQ(metrics.duration_s, 1.0);
  EXPECT_DOUBLE_EQ(metrics.realtime_factor, 2.0);
  EXPECT_EQ(metrics.distance_m, 0.0);
  EXPECT_EQ(metrics.speed_mps, 0.0);
  EXPECT_EQ(metrics.com_error_max_m, 0.0);
  EXPECT_EQ(metrics.base_height_error_rms_m, 0.0);
  EXPECT_EQ(metrics.friction_margin_min, 0.8);
  EXPECT_EQ(metrics.steps_taken, 0);
  EXPECT_EQ(metrics.fallback_ticks, 0);
  EXPECT_EQ(metrics.seed, 9u);
  EXPECT_EQ(metrics.version, "1.2.3");
}

TEST(Evaluator, NothingMeasuredIsNaN) {
  const Metrics metrics = HandMadeRun().metrics();
  EXPECT_TRUE(std::isnan(metrics.com_error_max_m));
  EXPECT_TRUE(std::isnan(metrics.com_error_rms_m));
  EXPECT_TRUE(std::isnan(metrics.friction_margin_min));
  EXPECT_TRUE(std::isnan(metrics.limb_extension_max_m));
  EXPECT_TRUE(std::isnan(metrics.tick_us.median));
}

TEST(Evaluator, SpeedCountsOnlyTheTimeInWhichWalkingIsCommanded) {
  HandMadeRun run;
  run.steps(400);
  run.tick.user.walk = true;
  for (int i = 0; i < 800; ++i) {
    run.truth.p_SB.x() = 0.3 * (i / 799.0);
    run.truth.p_SB.y() = 0.4 * (i / 799.0);
    run.step();
  }
  EXPECT_NEAR(run.metrics().distance_m, 0.5, 1e-12);
  EXPECT_NEAR(run.metrics().speed_mps, 0.25, 1e-12);
}

TEST(Evaluator, ComErrorIsThatInThePlane) {
  HandMadeRun run;
  run.truth.p_SCom = {0.003, 0.004, 0.4};
  run.step();
  run.truth.p_SCom = {0.0, 0.0, 0.4};
  run.steps(3);
  EXPECT_NEAR(run.metrics().com_error_max_m, 0.005, 1e-15);
  EXPECT_NEAR(run.metrics().com_error_rms_m, 0.0025, 1e-15);
}

TEST(Evaluator, SwayIsHalfTheRangeAcrossTheHeadingSeenFromTheFeet) {
  HandMadeRun run;
  run.tick.user.walk = true;
  run.tick.plan.R_WC =
      Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()).toRotationMatrix();  // heading along y
  for (const double lateral : {0.0, 0.04, -0.06, 0.01}) {
    // Feet and COM drift together along x, across the heading; that is no sway.
    const double drift = 10.0 * run.truth.time;
    for (FootPlan& foot : run.tick.plan.feet) foot.p_WF = {drift, 5.0, 0.0};
    run.truth.p_SCom = {drift + lateral, 3.0, 0.4};
    run.step();
  }
  EXPECT_NEAR(run.metrics().com_lateral_sway_m, 0.05, 1e-12);
}

TEST(Evaluator, TorsoErrorsAreRootMeanSquares) {
  HandMadeRun run;
  run.truth.p_SB.z() = 0.48;
  run.truth.q_SB = Quat(Eigen::AngleAxisd(0.1, Vec3(1.0, 2.0, 3.0).normalized()));
  run.step();
  run.truth.p_SB.z() = 0.41;
  run.truth.q_SB = Quat(Eigen::AngleAxisd(-0.2, Vec3::UnitX()));
  run.step();
  EXPECT_NEAR(run.metrics().base_height_error_rms_m, std::sqrt((0.03 * 0.03 + 0.04 * 0.04) / 2.0),
              1e-12);
  EXPECT_NEAR(run.metrics().orientation_error_rms_rad, std::sqrt((0.1 * 0.1 + 0.2 * 0.2) / 2.0),
              1e-7);
  EXPECT_NEAR(run.metrics().max_tilt_rad, 0.2, 1e-7);
}

TEST(Evaluator, StepsOfTheFramesAreTheLargestChangesBetweenTwoTicksOfOnePlan) {
  HandMadeRun run;
  const auto lean = [&](double torso, double height, double frame) {
    run.tick.plan.torso.q_WB = Quat(Eigen::AngleAxisd(torso, Vec3::UnitY()));
    run.tick.plan.torso.height = height;
    run.tick.plan.R_WC = Eigen::AngleAxisd(frame, Vec3::UnitX()).toRotationMatrix();
    run.step();
  };
  lean(0.5, 0.5, 0.5);  // before the first tick there is none
  lean(0.4, 0.53, 0.5);
  lean(0.2, 0.52, 0.25);
  run.tick.plan.calibration = CalibrationStage::settling;  // the plan restarts
  lean(-0.5, 0.2, 1.0);
  run.tick.plan.calibration = CalibrationStage::none;
  lean(0.3, 0.7, 0.0);
  EXPECT_NEAR(run.metrics().torso_reference_step_max_rad, 0.2, 1e-7);
  EXPECT_NEAR(run.metrics().torso_reference_step_max_m, 0.03, 1e-12);
  EXPECT_NEAR(run.metrics().control_frame_step_max_rad, 0.25, 1e-7);
}

TEST(Evaluator, TorqueStepIsTheLargestChangeOfACommand) {
  HandMadeRun run;
  run.tick.command.torque[4] = -30.0;  // before the first tick there is none
  run.truth.torque[1] = -35.0;
  run.step();
  run.tick.command.torque[4] = -22.0;
  run.tick.command.torque[5] = 3.0;
  run.truth.torque[1] = 0.0;
  run.step();
  EXPECT_EQ(run.metrics().torque_step_max_nm, 8.0);
  EXPECT_EQ(run.metrics().torque_command_max_nm, 30.0);
  EXPECT_EQ(run.metrics().torque_max_nm, 35.0);
}

TEST(Evaluator, TheTiltOfACalibrationCountsApart) {
  HandMadeRun run;
  run.step();
  EXPECT_TRUE(std::isnan(run.metrics().max_tilt_calibrating_rad));
  for (const auto& [stage, angle] :
       {std::pair{CalibrationStage::turning, 0.2}, std::pair{CalibrationStage::none, 0.1}}) {
    run.tick.plan.calibration = stage;
    run.truth.q_SB = Quat(Eigen::AngleAxisd(angle, Vec3::UnitX()));
    run.step();
  }
  EXPECT_NEAR(run.metrics().max_tilt_rad, 0.1, 1e-7);
  EXPECT_NEAR(run.metrics().max_tilt_calibrating_rad, 0.2, 1e-7);
}

TEST(Evaluator, TicksWithoutAnOptimumAreCounted) {
  HandMadeRun run;
  run.step();
  for (const CommandMode mode : {CommandMode::degraded, CommandMode::hold, CommandMode::optimal}) {
    run.tick.command.mode = mode;
    run.step();
  }
  EXPECT_EQ(run.metrics().fallback_ticks, 2);
}

TEST(Evaluator, WhatAStoppedControllerStillPlansIsNotJudged) {
  for (const StopCause cause : {StopCause::none, StopCause::tilt, StopCause::imu}) {
    HandMadeRun run;
    run.steps(10);
    run.tick.command.mode = CommandMode::hold;
    run.tick.command.cause = cause;
    run.tick.plan.com.p.x() = 0.1;
    run.tick.plan.torso.height = 0.6;
    run.truth.q_SB = Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
    run.phase(Leg::LF, LegPhase::swing);
    run.steps(2);
    run.phase(Leg::LF, LegPhase::stance);
    run.steps(2);
    const Metrics metrics = run.metrics();
    const bool is_judged = cause == StopCause::none;
    EXPECT_EQ(metrics.com_error_max_m > 0.05, is_judged);
    EXPECT_EQ(metrics.base_height_error_rms_m > 0.0, is_judged);
    EXPECT_EQ(metrics.steps_taken, is_judged ? 1 : 0);
    EXPECT_NEAR(metrics.max_tilt_rad, 0.3, 1e-6) << "of the robot, not of the plan";
    EXPECT_EQ(metrics.fallback_ticks, 4);
  }
}

TEST(Evaluator, TimesAreSummedUpByTheirRank) {
  HandMadeRun run;
  for (int i = 100; i >= 1; --i) {
    run.evaluator.add(
        TickTiming{.time = 0.0, .solve = static_cast<double>(i), .total = 1000.0 + i});
  }
  EXPECT_EQ(run.metrics().tick_us.median, 1050.0);
  EXPECT_EQ(run.metrics().tick_us.p99, 1099.0);
  EXPECT_EQ(run.metrics().tick_us.max, 1100.0);
  EXPECT_EQ(run.metrics().solve_us.median, 50.0);
}

}  // namespace
}  // namespace surefoot::evaluation
