#include "surefoot/estimation/external_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kMass = 30.0;

/// A lump of the robot's mass that four feet carry, and that something pushes.
struct Lump {
  Lump() {
    dynamics.mass = kMass;
    state.time = 0.0;
    state.foot_force.fill(0.25 * kMass * kGravity * Vec3::UnitZ());
    for (const Leg leg : kLegs) {
      dynamics.contact[index(leg)].p = {is_front(leg) ? 0.3 : -0.3, is_left(leg) ? 0.2 : -0.2, 0.0};
    }
  }

  void run(ExternalForceEstimator& estimator, double duration, const Vec3& acceleration) {
    for (double t = 0.0; t < duration; t += kPeriod) {
      state.time += kPeriod;
      dynamics.com.v += kPeriod * acceleration;
      estimator.update(dynamics, stands, state);
    }
  }

  Dynamics dynamics;
  RobotState state;
  PerLeg<bool> stands{true, true, true, true};
};

TEST(ExternalForce, APushIsFoundBeyondTheDeadBand) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  lump.run(estimator, 10.0 * options.time_constant, Vec3(0.0, 50.0 / kMass, 0.0));
  EXPECT_NEAR(estimator.force().y(), 50.0, 0.5);
  const double share = 1.0 - std::pow(options.dead_band / 50.0, 2);
  EXPECT_NEAR(lump.state.external_force.y(), share * 50.0, 0.5);
  EXPECT_NEAR(lump.state.external_force.x(), 0.0, 1e-6);
}

TEST(ExternalForce, WhatTheGroundTakesUpIsAPushToo) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  for (Vec3& force : lump.state.foot_force) force.x() = -10.0;
  lump.run(estimator, 10.0 * options.time_constant, Vec3::Zero());
  EXPECT_NEAR(estimator.force().x(), 40.0, 0.5);
}

TEST(ExternalForce, WithinTheDeadBandThereIsNone) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  lump.run(estimator, 1.0, Vec3(0.9 * options.dead_band / kMass, 0.0, 0.0));
  EXPECT_EQ(lump.state.external_force, Vec3::Zero());
}

TEST(ExternalForce, APayloadIsAForceDownwardAndAMoment) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  for (const Leg leg : {Leg::LF, Leg::RF}) lump.state.foot_force[index(leg)].z() += 30.0;
  lump.run(estimator, 10.0 * options.load_time_constant, Vec3::Zero());
  const double share = 1.0 - std::pow(options.load_dead_band / 60.0, 2);
  EXPECT_NEAR(lump.state.external_force.z(), -share * 60.0, 0.5);
  EXPECT_NEAR(estimator.moment().y(), 60.0 * 0.3, 0.5);
  EXPECT_NEAR(estimator.moment().x(), 0.0, 1e-6);
}

TEST(ExternalForce, AFootInTheAirDoesNotCount) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  lump.stands[index(Leg::LF)] = false;
  for (Vec3& force : lump.state.foot_force) force.z() *= 4.0 / 3.0;
  lump.state.foot_force[index(Leg::LF)] = {80.0, 80.0, 80.0};
  lump.run(estimator, 1.0, Vec3::Zero());
  EXPECT_LT(estimator.force().norm(), 0.5);
}

TEST(ExternalForce, IsLimited) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  lump.run(estimator, 1.0, Vec3(100.0, 0.0, 0.0));
  EXPECT_NEAR(lump.state.external_force.norm(), options.max_force, 1e-6);
}

TEST(ExternalForce, ForgetsNumbersThatAreNotFinite) {
  const ExternalForceOptions options;
  ExternalForceEstimator estimator(options);
  Lump lump;
  lump.run(estimator, 0.5, Vec3::Zero());
  const Vec3 force = lump.state.foot_force[0];
  lump.state.foot_force[0].setConstant(kNaN);
  lump.run(estimator, 0.1, Vec3::Zero());
  EXPECT_EQ(lump.state.external_force, Vec3::Zero());
  lump.state.foot_force[0] = force;
  lump.run(estimator, 1.0, Vec3(0.0, 50.0 / kMass, 0.0));
  EXPECT_NEAR(estimator.force().y(), 50.0, 0.5);
}

}  // namespace
}  // namespace surefoot
