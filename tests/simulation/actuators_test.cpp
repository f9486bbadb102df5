#include "surefoot/simulation/actuators.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::simulation {
namespace {

const JointVector kStill = JointVector::Zero(kNumLegJoints);
const JointVector kLimit = JointVector::Constant(kNumLegJoints, 40.0);
constexpr double kTimestep = 0.0005;
constexpr int kStepsPerTick = 5;

ActuatorOptions sea() {
  ActuatorOptions options;
  options.model = ActuatorModel::sea;
  options.quantisation = 0.0;
  return options;
}

JointVector constant(double torque) { return JointVector::Constant(kNumLegJoints, torque); }

/// Commands a torque for so many control ticks.
void hold(Actuators& actuators, double torque, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) {
    actuators.command(constant(torque));
    for (int step = 0; step < kStepsPerTick; ++step) actuators.advance(kStill);
  }
}

TEST(IdealActuators, GiveTheCommandAtOnceAndUntilTheNext) {
  Actuators actuators({}, kLimit, kTimestep);
  actuators.command(constant(-12.3456));
  EXPECT_EQ(actuators.torque(kStill, kStill), constant(-12.3456));
  actuators.advance(kStill);
  EXPECT_EQ(actuators.torque(kStill, constant(11.0)), constant(-12.3456));
}

TEST(IdealActuators, ClipEachJointAtItsOwnLimit) {
  JointVector limit = kLimit;
  limit[4] = 15.0;
  Actuators actuators({}, limit, kTimestep);
  actuators.command(constant(100.0));
  EXPECT_EQ(actuators.torque(kStill, kStill), limit);
  actuators.command(constant(-100.0));
  EXPECT_EQ(actuators.torque(kStill, kStill), -limit);
}

TEST(SeaActuators, ReachSixtyThreePercentAfterOneTimeConstant) {
  const double time_constant = 1.0 / (2.0 * kPi * 70.0);
  ActuatorOptions options = sea();
  options.delay_ticks = 0;
  for (const int steps : {1, 4, 32}) {
    Actuators actuators(options, kLimit, time_constant / steps);
    actuators.command(constant(10.0));
    for (int i = 0; i < steps; ++i) actuators.advance(kStill);
    EXPECT_NEAR(actuators.torque(kStill, kStill)[0], 10.0 * (1.0 - std::exp(-1.0)), 1e-9) << steps;
  }
}

TEST(SeaActuators, ApplyNothingBeforeTheDelayHasPassed) {
  for (const int delay : {1, 2, 5}) {
    ActuatorOptions options = sea();
    options.delay_ticks = delay;
    Actuators actuators(options, kLimit, kTimestep);
    hold(actuators, 20.0, delay);
    EXPECT_EQ(actuators.torque(kStill, kStill), kStill) << delay;
    hold(actuators, 20.0, 1);
    const double share = 1.0 - std::exp(-2.0 * kPi * 70.0 * kStepsPerTick * kTimestep);
    EXPECT_NEAR(actuators.torque(kStill, kStill)[7], 20.0 * share, 1e-9) << delay;
  }
}

TEST(SeaActuators, HoldTheTorqueThatTheyRestAtUntilACommandArrives) {
  for (const int level : {1, 2}) {
    for (const int delay : {0, 3}) {
      ActuatorOptions options = sea();
      options.level = level;
      options.delay_ticks = delay;
      options.torque_gain = 0.9;
      Actuators actuators(options, kLimit, kTimestep);
      actuators.rest_at(kStill, constant(10.0));
      EXPECT_NEAR(actuators.torque(kStill, kStill)[0], 10.0, 1e-9) << level << " " << delay;
      for (int tick = 0; tick < delay; ++tick) {
        hold(actuators, 0.0, 1);
        EXPECT_NEAR(actuators.torque(kStill, kStill)[0], 10.0, 0.2) << level << " " << tick;
      }
      hold(actuators, 0.0, 40);
      EXPECT_NEAR(actuators.torque(kStill, kStill)[0], 0.0, 1.0) << level << " " << delay;
    }
  }
}

TEST(SeaActuators, KeepTheOrderOfDelayedCommands) {
  ActuatorOptions options = sea();
  options.delay_ticks = 3;
  options.bandwidth_hz = 1e6;  // no lag to speak of
  Actuators actuators(options, kLimit, kTimestep);
  for (int tick = 0; tick < 12; ++tick) {
    hold(actuators, tick, 1);
    EXPECT_NEAR(actuators.torque(kStill, kStill)[0], std::max(0, tick - 3), 1e-9);
  }
}

TEST(SeaActuators, LoseTorqueAlongTheTorqueSpeedLineWhenTheyDrive) {
  ActuatorOptions options = sea();
  options.stall_torque.setConstant(40.0);
  options.no_load_speed.setConstant(12.0);
  Actuators actuators(options, kLimit, kTimestep);
  hold(actuators, 40.0, 40);
  EXPECT_NEAR(actuators.torque(kStill, constant(0.0))[0], 40.0, 1e-6);
  EXPECT_NEAR(actuators.torque(kStill, constant(3.0))[0], 30.0, 1e-6);
  EXPECT_NEAR(actuators.torque(kStill, constant(9.0))[0], 10.0, 1e-6);
  EXPECT_NEAR(actuators.torque(kStill, constant(12.0))[0], 0.0, 1e-6);
  EXPECT_NEAR(actuators.torque(kStill, constant(20.0))[0], 0.0, 1e-6);
}

TEST(SeaActuators, KeepTheirFullTorqueWhenTheyBrake) {
  Actuators actuators(sea(), kLimit, kTimestep);
  hold(actuators, 40.0, 40);
  EXPECT_NEAR(actuators.torque(kStill, constant(-6.0))[0], 40.0, 1e-6);
  hold(actuators, -40.0, 40);
  EXPECT_NEAR(actuators.torque(kStill, constant(6.0))[0], -40.0, 1e-6);
  EXPECT_NEAR(actuators.torque(kStill, constant(-6.0))[0], -20.0, 1e-6);
}

TEST(SeaActuators, RoundToWholeQuanta) {
  ActuatorOptions options = sea();
  options.quantisation = 0.2;
  Actuators actuators(options, kLimit, kTimestep);
  for (const auto& [commanded, applied] :
       {std::pair{7.31, 7.4}, {7.29, 7.2}, {-7.31, -7.4}, {-7.29, -7.2}, {0.09, 0.0}}) {
    hold(actuators, commanded, 40);
    EXPECT_NEAR(actuators.torque(kStill, kStill)[0], applied, 1e-12) << commanded;
  }
}

TEST(SeaActuators, StayInsideTheLimitsWithAGainAboveOneAndACoarseQuantum) {
  ActuatorOptions options = sea();
  options.torque_gain = 1.1;
  options.stall_torque.setConstant(80.0);
  for (const double quantum : {0.0, 0.2, 0.6, 0.7}) {
    options.quantisation = quantum;
    Actuators actuators(options, kLimit, kTimestep);
    hold(actuators, 1000.0, 40);
    EXPECT_LE(actuators.torque(kStill, kStill).maxCoeff(), 40.0 + 1e-12) << quantum;
    EXPECT_GE(actuators.torque(kStill, kStill).minCoeff(), 40.0 - quantum) << quantum;
    hold(actuators, -1000.0, 40);
    EXPECT_GE(actuators.torque(kStill, kStill).minCoeff(), -40.0 - 1e-12) << quantum;
  }
}

TEST(SeaActuators, MultiplyEachJointByItsOwnGainAtBothLevels) {
  ActuatorOptions options = sea();
  options.torque_gain = 0.9;
  options.joint_torque_gain[3] = 1.1;
  for (const int level : {1, 2}) {
    options.level = level;
    Actuators actuators(options, kLimit, kTimestep);
    actuators.rest_at(kStill, kStill);
    hold(actuators, 20.0, 400);
    EXPECT_NEAR(actuators.torque(kStill, kStill)[3], 19.8, 1e-3) << level;
    EXPECT_NEAR(actuators.torque(kStill, kStill)[4], 18.0, 1e-3) << level;
  }
}

TEST(SeaActuators, OfLevelTwoStartWithoutTorqueAndWaitForTheDelay) {
  ActuatorOptions options = sea();
  options.level = 2;
  options.delay_ticks = 2;
  Actuators actuators(options, kLimit, kTimestep);
  const JointVector q = JointVector::Constant(kNumLegJoints, 0.7);
  actuators.rest_at(q, kStill);
  EXPECT_EQ(actuators.torque(q, kStill), kStill);
  for (int tick = 0; tick < 2; ++tick) {
    actuators.command(constant(20.0));
    for (int step = 0; step < kStepsPerTick; ++step) actuators.advance(q);
  }
  EXPECT_LT(actuators.torque(q, kStill).norm(), 1e-9);
  actuators.command(constant(20.0));
  for (int step = 0; step < 200; ++step) actuators.advance(q);
  EXPECT_NEAR(actuators.torque(q, kStill)[0], 20.0, 0.1);
}

}  // namespace
}  // namespace surefoot::simulation
