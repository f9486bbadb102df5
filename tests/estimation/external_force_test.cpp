#include "surefoot/estimation/external_force.hpp"

#include "surefoot/model/robot_model.hpp"
#include "tests/support/anymal_b.hpp"
#include "tests/support/random_motion.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kMass = 30.0;
const ExternalForceOptions kOptions;

/// A lump of the robot's mass on four feet, pushed by something.
struct Lump {
  Lump() {
    dynamics.mass = kMass;
    state.time = 0.0;
    state.foot_force.fill(0.25 * kMass * kGravity * Vec3::UnitZ());
    for (const Leg leg : kLegs) {
      dynamics.contact[index(leg)].p = {is_front(leg) ? 0.3 : -0.3, is_left(leg) ? 0.2 : -0.2, 0.0};
    }
  }

  void run(double duration, const Vec3& acceleration) {
    for (double t = 0.0; t < duration; t += kPeriod) {
      state.time += kPeriod;
      dynamics.com.v += kPeriod * acceleration;
      estimator.update(dynamics, stands, state);
    }
  }

  ExternalForceEstimator estimator{kOptions};
  model::Dynamics dynamics;
  RobotState state;
  PerLeg<bool> stands{true, true, true, true};
};

TEST(ExternalForce, APushIsFoundBeyondTheDeadBand) {
  Lump lump;
  lump.run(10.0 * kOptions.time_constant, Vec3(0.0, 50.0 / kMass, 0.0));
  EXPECT_NEAR(lump.estimator.force().y(), 50.0, 0.5);
  const double share = 1.0 - std::pow(kOptions.dead_band / 50.0, 2);
  EXPECT_NEAR(lump.state.external_force.y(), share * 50.0, 0.5);
  EXPECT_NEAR(lump.state.external_force.x(), 0.0, 1e-6);
}

// A weighed load fades in while it moves.
TEST(ExternalForce, WhatTheModelTakesOverIsNoLongerALoad) {
  Lump lump;
  constexpr double kPayload = 7.0;
  for (Vec3& force : lump.state.foot_force) force.z() += 0.25 * kPayload * kGravity;
  lump.run(20.0 * kOptions.load_time_constant, Vec3::Zero());
  EXPECT_NEAR(lump.estimator.force().z(), -kPayload * kGravity, 0.1);
  lump.dynamics.com.v = {0.1, 0.0, 0.02};
  lump.run(20.0 * kOptions.load_time_constant, Vec3::Zero());
  const double load = lump.estimator.force().z() - kGravity * lump.dynamics.mass;
  for (int i = 0; i < 200; ++i) {
    lump.dynamics.mass += kPayload / 200;
    lump.run(kPeriod, Vec3::Zero());
    EXPECT_NEAR(lump.estimator.force().z() - kGravity * lump.dynamics.mass, load, 1.0);
    EXPECT_NEAR(lump.estimator.force().x(), 0.0, 0.1);
  }
}

TEST(ExternalForce, WhatTheGroundTakesUpIsAPushToo) {
  Lump lump;
  for (Vec3& force : lump.state.foot_force) force.x() = -10.0;
  lump.run(10.0 * kOptions.time_constant, Vec3::Zero());
  EXPECT_NEAR(lump.estimator.force().x(), 40.0, 0.5);
}

TEST(ExternalForce, APayloadIsAForceDownwardAndAMoment) {
  Lump lump;
  for (const Leg leg : {Leg::LF, Leg::RF}) lump.state.foot_force[index(leg)].z() += 30.0;
  lump.run(10.0 * kOptions.load_time_constant, Vec3::Zero());
  const double share = 1.0 - std::pow(kOptions.load_dead_band / 60.0, 2);
  EXPECT_NEAR(lump.state.external_force.z(), -share * 60.0, 0.5);
  EXPECT_NEAR(lump.estimator.moment().y(), 60.0 * 0.3, 0.5);
  EXPECT_NEAR(lump.estimator.moment().x(), 0.0, 1e-6);
}

TEST(ExternalForce, AFootInTheAirDoesNotCount) {
  Lump lump;
  lump.stands[index(Leg::LF)] = false;
  for (Vec3& force : lump.state.foot_force) force.z() *= 4.0 / 3.0;
  lump.state.foot_force[index(Leg::LF)] = {80.0, 80.0, 80.0};
  lump.run(1.0, Vec3::Zero());
  EXPECT_LT(lump.estimator.force().norm(), 0.5);
}

TEST(ExternalForce, IsLimitedAndSoAreALoadAndItsMoment) {
  Lump lump, laden;
  lump.run(1.0, Vec3(100.0, 0.0, 0.0));
  EXPECT_NEAR(lump.state.external_force.norm(), kOptions.max_force, 1e-6);
  for (const Leg leg : {Leg::LF, Leg::RF}) laden.state.foot_force[index(leg)].z() += 200.0;
  laden.run(10.0 * kOptions.load_time_constant, Vec3::Zero());
  EXPECT_NEAR(laden.state.external_force.z(), -kOptions.max_force, 1e-6);
  EXPECT_NEAR(laden.state.external_moment.norm(), kOptions.max_moment, 1e-6);
}

TEST(ExternalForce, AfterALongerGapItBeginsAnew) {
  Lump lump;
  lump.run(10.0 * kOptions.time_constant, Vec3(0.0, 50.0 / kMass, 0.0));
  lump.state.time += 0.06;
  lump.run(kPeriod, Vec3::Zero());
  EXPECT_EQ(lump.estimator.force(), Vec3::Zero());
  EXPECT_EQ(lump.state.external_force, Vec3::Zero());
}

TEST(ExternalForce, WithinTheDeadBandOrSwitchedOffThereIsNone) {
  Lump lump, off;
  lump.run(1.0, Vec3(0.9 * kOptions.dead_band / kMass, 0.0, 0.0));
  off.estimator = ExternalForceEstimator({.enabled = false});
  off.run(1.0, Vec3(0.0, 50.0 / kMass, 0.0));
  for (const Lump* one : {&lump, &off}) {
    EXPECT_EQ(one->state.external_force, Vec3::Zero());
    EXPECT_EQ(one->state.external_moment, Vec3::Zero());
  }
}

TEST(ExternalForce, ForgetsNumbersThatAreNotFinite) {
  Lump lump;
  lump.run(0.5, Vec3::Zero());
  const Vec3 force = lump.state.foot_force[0];
  lump.state.foot_force[0].setConstant(kNaN);
  lump.run(0.1, Vec3::Zero());
  EXPECT_EQ(lump.state.external_force, Vec3::Zero());
  lump.state.foot_force[0] = force;
  lump.run(1.0, Vec3(0.0, 50.0 / kMass, 0.0));
  EXPECT_NEAR(lump.estimator.force().y(), 50.0, 0.5);
}

TEST(ExternalForce, TheWrenchOnARobotThatTumblesIsFound) {
  constexpr int kSubsteps = 50;
  constexpr double kStep = kPeriod / kSubsteps;
  const ExternalForceOptions options{.time_constant = 0.02, .load_time_constant = 0.02};
  test::Random random(3);
  for (int trial = 0; trial < 3; ++trial) {
    model::RobotModel model(test::anymal_b());
    ExternalForceEstimator estimator(options);
    RobotState state = random.standing_state(model.description().q_nominal);
    state.w_WB_B = random.vector(2.0);
    state.qd = JointVector::NullaryExpr([&] { return random.uniform(-3.0, 3.0); });
    const Vec3 force = random.vector(60.0), moment = random.vector(15.0);
    state.time = 0.0;
    for (int tick = 0; tick < 60; ++tick) {  // 7 time constants
      for (int i = 0; i < kSubsteps; ++i) {
        model.update(state, Vec3::UnitZ());
        model.apply_wrench(force, moment);
        const model::Dynamics& dynamics = model.dynamics();
        const GeneralizedVector u = state.u() - kStep * dynamics.M.llt().solve(dynamics.h);
        state = test::moved(state, u, kStep);
        state.v_WB = u.head<3>();
        state.w_WB_B = u.segment<3>(3);
        state.qd = u.tail<kNumLegJoints>();
      }
      state.time = kPeriod * (tick + 1);
      estimator.update(model.update(state, Vec3::UnitZ()), {}, state);
    }
    EXPECT_LT((estimator.force() - force).norm(), 1.0) << force.transpose();
    EXPECT_LT((estimator.moment() - moment).norm(), 0.5) << moment.transpose();
  }
}

}  // namespace
}  // namespace surefoot::estimation
