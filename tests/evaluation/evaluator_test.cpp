#include "surefoot/evaluation/evaluator.hpp"

#include "surefoot/signals/plan_event.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::evaluation {
namespace {

using test::holds;

constexpr double kPeriod = 0.0025;
constexpr double kMass = 30.0;  // a tenth of its weight is 29.43 N

// A run made by hand: each test changes what it is about and calls `tick`.
struct HandMadeRun {
  HandMadeRun()
      : HandMadeRun(
            {.control_period = kPeriod, .mass = kMass, .terrain_height = {}, .hip_in_base = {}}) {}
  explicit HandMadeRun(EvaluatorOptions options) : evaluator(std::move(options)) { stand(); }

  void stand() {
    truth.p_SB.z() = 0.45;
    for (simulation::TrueContact& contact : truth.feet) {
      contact = {.touching = true, .force = Vec3(0.0, 0.0, 75.0), .friction = 0.8};
    }
    tick.plan.torso.height = 0.45;
    tick.command.mode = CommandMode::optimal;
  }

  void step() {
    evaluator.add(truth, tick);
    truth.time += kPeriod;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }

  [[nodiscard]] Metrics metrics() const {
    return evaluator.metrics(
        {.reason = "completed", .wall_seconds = 0.5, .seed = 9, .version = "1.2.3"});
  }

  void phase(Leg leg, LegPhase phase) { tick.plan.feet[index(leg)].phase = phase; }
  simulation::TrueContact& contact(Leg leg) { return truth.feet[index(leg)]; }

  Evaluator evaluator;
  simulation::GroundTruth truth;
  TickRecord tick;
};

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

TEST(Evaluator, FrictionMarginIsOfTheWorstStanceFootThatCarries) {
  HandMadeRun run;
  run.contact(Leg::LF).force = {24.0, -32.0, 100.0};  // a ratio of 0.4, of at most 0.8
  run.contact(Leg::RF).force = {23.2, 0.0, 29.0};     // light, on the cone's boundary
  run.contact(Leg::LH).force = {64.0, 0.0, 80.0};
  run.phase(Leg::LH, LegPhase::swing);  // not a stance
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_loaded_min, 0.4, 1e-12);
  EXPECT_NEAR(run.metrics().friction_margin_min, 0.0, 1e-12);
  run.contact(Leg::RF).force = {21.0, 0.0, 30.0};  // just heavy enough
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_loaded_min, 0.1, 1e-12);
}

TEST(Evaluator, FrictionMarginFollowsTheContactsNormalAndItsFrictionAndIsZeroWithoutASign) {
  HandMadeRun run;
  const Vec3 normal = Vec3(0.6, 0.0, 0.8);
  run.contact(Leg::RH).normal = normal;
  run.contact(Leg::RH).force = 100.0 * normal + 20.0 * Vec3::UnitY();
  run.contact(Leg::RH).friction = 0.7;
  run.step();
  EXPECT_NEAR(run.metrics().friction_margin_min, 0.5, 1e-12);
  run.contact(Leg::LF).force = {80.0 + 1e-12, 0.0, 100.0};  // it slides
  run.step();
  EXPECT_EQ(run.metrics().friction_margin_min, 0.0);
  EXPECT_FALSE(std::signbit(run.metrics().friction_margin_min));
}

TEST(Evaluator, TheMarginOfLoadedFeetNeedsTheRobotsMass) {
  HandMadeRun run({.control_period = kPeriod, .terrain_height = {}, .hip_in_base = {}});
  run.step();
  EXPECT_TRUE(std::isnan(run.metrics().friction_margin_loaded_min));
}

TEST(Evaluator, FeetThatAreTakenBackAreCounted) {
  HandMadeRun run;
  for (const PlanEvent event : {PlanEvent::none, PlanEvent::no_ground, PlanEvent::late,
                                PlanEvent::touchdown, PlanEvent::no_ground}) {
    run.tick.plan.events = {};
    run.tick.plan.events.add({.kind = event});
    run.step();
  }
  EXPECT_EQ(run.metrics().no_ground_events, 2);
}

TEST(Evaluator, SlipIsThePathWithinOneStance) {
  HandMadeRun run;
  const auto stance = [&run](double metres) {
    run.phase(Leg::RF, LegPhase::stance);
    run.contact(Leg::RF).slip_velocity = {0.0, metres / (10 * kPeriod), 0.0};
    run.steps(5);
    run.contact(Leg::RF).slip_velocity *= -1.0;  // back again: the path counts
    run.steps(5);
  };
  stance(0.003);
  run.phase(Leg::RF, LegPhase::swing);
  run.steps(10);  // moves through the air
  stance(0.004);
  EXPECT_NEAR(run.metrics().foot_slip_max_m, 0.004, 1e-12);
}

TEST(Evaluator, StepsAreSwingsThatEndInStance) {
  HandMadeRun run;
  for (const LegPhase phase : {LegPhase::unloading, LegPhase::swing, LegPhase::search,
                               LegPhase::stance, LegPhase::unloading, LegPhase::swing}) {
    run.phase(Leg::LF, phase);
    run.steps(3);
  }
  EXPECT_EQ(run.metrics().steps_taken, 1);
}

TEST(Evaluator, SearchIsTheLongestOfAnyFootWithoutABreak) {
  HandMadeRun run;
  const auto search = [&run](int ticks) {
    run.phase(Leg::LF, LegPhase::search);
    run.steps(ticks);
    run.phase(Leg::LF, LegPhase::stance);
    run.step();
  };
  search(40);
  search(100);
  search(60);
  EXPECT_NEAR(run.metrics().search_max_s, 0.25, 1e-12);
}

TEST(Evaluator, EdgeLandingsAreJudgedOnceWhenTheFootIsFirstLoaded) {
  HandMadeRun run({.control_period = kPeriod,
                   .terrain_height = [](double x, double) { return x < 1.0 ? 0.0 : -0.14; },
                   .hip_in_base = {}});
  simulation::TrueContact& contact = run.contact(Leg::RF);
  contact.point = {0.995, 0.0, 0.0};  // stands on the edge from the beginning: not a landing
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 0);
  run.phase(Leg::RF, LegPhase::swing);
  run.step();
  run.phase(Leg::RF, LegPhase::stance);
  contact.force = Vec3::Zero();
  run.step();  // touches, but nothing rests on it yet
  EXPECT_EQ(run.metrics().edge_landings, 0);
  contact.force = {0.0, 0.0, 30.0};
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 1);
  run.phase(Leg::RF, LegPhase::swing);
  run.step();
  contact.point = {0.95, 0.0, 0.0};
  run.phase(Leg::RF, LegPhase::stance);
  run.steps(5);
  EXPECT_EQ(run.metrics().edge_landings, 1);
  EXPECT_EQ(run.metrics().steps_taken, 2);
}

TEST(Evaluator, LimbExtensionIsFromTheTrueHipToTheTrueFoot) {
  HandMadeRun run(
      {.control_period = kPeriod, .terrain_height = {}, .hip_in_base = [](Leg leg, const Vec3& q) {
         return Vec3(leg == Leg::RH ? q[2] : 0.0, 0.0, 0.0);
       }});
  run.truth.p_SB = {1.0, 2.0, 0.45};
  run.truth.q_SB = Quat(Eigen::AngleAxisd(kPi / 2.0, Vec3::UnitZ()));
  run.truth.q[first_joint(Leg::RH) + 2] = 0.3;  // the hip 0.3 m along B's x, which is W's y
  for (Vec3& p_SF : run.truth.p_SF) p_SF = {1.0, 2.0, 0.05};
  run.step();
  EXPECT_NEAR(run.metrics().limb_extension_max_m, 0.5, 1e-12);
}

TEST(Evaluator, BodyContactsAreCountedWhenTheyBegin) {
  HandMadeRun run;
  for (const int mask : {0, 0b0010, 0b0010, 0b0110, 0b0100, 0b0000, 0b0001}) {
    run.truth.shank_contacts = mask;
    run.step();
  }
  EXPECT_EQ(run.metrics().shank_contacts, 3);
  EXPECT_EQ(run.metrics().torso_contacts, 0);
  EXPECT_FALSE(run.metrics().fell) << "a scraping shin is no fall";
}

TEST(Evaluator, TheTorsoOnTheGroundIsAFall) {
  HandMadeRun run;
  run.steps(400);
  run.truth.torso_contact = true;
  run.step();
  run.truth.torso_contact = false;
  run.steps(10);
  EXPECT_TRUE(run.evaluator.fell());
  EXPECT_TRUE(run.metrics().fell);
  EXPECT_EQ(run.metrics().torso_contacts, 1);
  EXPECT_EQ(run.metrics().reason, "fell at 1.0000 s: the torso touched the ground");
}

TEST(Evaluator, ALiftedRobotHasNotFallenNorOneThatGetsUp) {
  HandMadeRun run;
  run.step();
  run.tick.command.mode = CommandMode::lifted;
  run.truth.q_SB = Quat(Eigen::AngleAxisd(1.2, Vec3::UnitX()));
  run.truth.torque[3] = -7.0;
  run.steps(400);
  run.truth.q_SB.setIdentity();
  run.tick.command.mode = CommandMode::rise;
  run.truth.torso_contact = true;
  run.truth.p_SB.z() = 0.1;
  run.truth.torque[3] = 22.0;
  run.steps(200);
  const Metrics metrics = run.metrics();
  EXPECT_FALSE(metrics.fell) << run.evaluator.fall();
  EXPECT_NEAR(metrics.lifted_s, 1.0, 1e-9);
  EXPECT_NEAR(metrics.standing_up_s, 0.5, 1e-9);
  EXPECT_EQ(metrics.torque_lifted_max_nm, 7.0);
  EXPECT_EQ(metrics.torque_standing_up_max_nm, 22.0);
  run.tick.command.mode = CommandMode::optimal;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, WhoseTorsoIsOnTheGroundHasFallenThoughItSeemsLifted) {
  HandMadeRun run;
  run.step();
  run.tick.command.mode = CommandMode::lifted;
  run.step();
  EXPECT_FALSE(run.evaluator.fell());
  run.truth.torso_contact = true;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, ALowBaseIsAFallAndACrouchIsNot) {
  HandMadeRun run;
  for (Vec3& p_SF : run.truth.p_SF) p_SF.z() = -0.14 + 0.031;
  run.truth.p_SF[index(Leg::LF)].z() = 0.36;  // swings high: those that stand count
  run.contact(Leg::LF).touching = false;
  run.truth.p_SB.z() = -0.14 + 0.031 + 0.125;
  run.step();
  EXPECT_FALSE(run.evaluator.fell());
  run.truth.p_SB.z() -= 0.01;
  run.step();
  EXPECT_TRUE(run.evaluator.fell());
}

TEST(Evaluator, AFallIsToldByTheHipsWhereverTheBasesOriginIs) {
  for (const double hips : {-0.08, 0.05}) {
    EvaluatorOptions options;
    options.scale.hip_height = hips;
    HandMadeRun run(options);
    run.truth.p_SB.z() = run.truth.p_SF[0].z() + 0.125 - hips;
    run.step();
    EXPECT_FALSE(run.evaluator.fell()) << hips;
    run.truth.p_SB.z() -= 0.01;
    run.step();
    EXPECT_TRUE(run.evaluator.fell()) << hips;
  }
}

TEST(Evaluator, ATiltBeyondSixtyDegreesIsAFallAndYawIsNoTilt) {
  HandMadeRun run;
  const auto turn = [&](double angle, const Vec3& axis) {
    run.truth.q_SB = Quat(Eigen::AngleAxisd(angle, axis));
    run.step();
    return run.evaluator.fell();
  };
  EXPECT_FALSE(turn(3.0, Vec3::UnitZ()));
  EXPECT_NEAR(run.metrics().max_tilt_rad, 0.0, 1e-7);
  EXPECT_FALSE(turn(59.0 * kPi / 180.0, Vec3(0.6, 0.8, 0.0)));
  EXPECT_TRUE(turn(61.0 * kPi / 180.0, Vec3(0.6, 0.8, 0.0)));
  EXPECT_TRUE(holds(run.evaluator.fall(), "60°"));
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

TEST(Evaluator, PenetrationIsTheDeepestOfAnyFoot) {
  HandMadeRun run;
  run.contact(Leg::LH).penetration = 0.002;
  run.step();
  run.contact(Leg::LH).penetration = 0.0;
  run.step();
  EXPECT_EQ(run.metrics().penetration_max_m, 0.002);
}

}  // namespace
}  // namespace surefoot::evaluation
