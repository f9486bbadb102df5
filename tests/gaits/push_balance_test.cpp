#include "surefoot/gaits/parts/push_balance.hpp"

#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kWeight = 300.0;  // [N]
constexpr double kHeight = 0.45;   // [m]

RobotState loaded(const Vec3& force, const Vec3& moment) {
  RobotState state;
  state.external_force = force;
  state.external_moment = moment;
  return state;
}

model::Dynamics standing() {
  model::Dynamics result;
  result.mass = kWeight / kGravity;
  return result;
}

PushBalance after(const RobotState& state, const model::Dynamics& dynamics = standing()) {
  PushBalance balance({}, kPeriod);
  balance.update(state, dynamics, kHeight);
  return balance;
}

TEST(PushBalance, TheGroundsForceThroughTheShiftedZmpBalancesTheLoad) {
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Vec3 force = random.vector(60.0), moment = random.vector(15.0);
    const PushBalance balance = after(loaded(force, moment));
    const Vec3 zmp(balance.shift().x(), balance.shift().y(), -kHeight);  // from the COM
    const Vec3 ground = kWeight * Vec3::UnitZ() - force;
    const Vec3 about_com = zmp.cross(ground) + moment;
    EXPECT_LT(about_com.head<2>().norm(), 1e-9) << force.transpose();
  }
}

TEST(PushBalance, APayloadInFrontMovesTheZmpForwardAndNothingElseDoes) {
  const Vec3 force(0.0, 0.0, -60.0), place(0.2, 0.0, 0.1);
  const PushBalance balance = after(loaded(force, place.cross(force)));
  EXPECT_NEAR(balance.shift().x(), 60.0 * 0.2 / 360.0, 1e-12);
  EXPECT_NEAR(balance.shift().y(), 0.0, 1e-12);
  EXPECT_FALSE(balance.is_pushed()) << "it pushes nowhere";
}

TEST(PushBalance, APushLeansAHeavierRobotLess) {
  model::Dynamics laden = standing();
  laden.mass *= 1.25;
  const RobotState pushed = loaded(Vec3(50.0, 0.0, 0.0), Vec3::Zero());
  EXPECT_NEAR(after(pushed, laden).shift().x(), after(pushed).shift().x() / 1.25, 1e-12);
}

TEST(PushBalance, TheCapturePointIsThatOfThePendulum) {
  model::Dynamics dynamics = standing();
  dynamics.com.p = {1.0, 2.0, kHeight};
  dynamics.com.v = {0.3, -0.1, 0.0};
  const PushBalance balance = after(loaded(Vec3::Zero(), Vec3::Zero()), dynamics);
  const Vec2 ahead = std::sqrt(kHeight / kGravity) * Vec2(0.3, -0.1);
  EXPECT_LT((balance.capture_point() - Vec2(1.0, 2.0) - ahead).norm(), 1e-12);
  EXPECT_NEAR(balance.growth(0.2), std::exp(0.2 * std::sqrt(kGravity / kHeight)), 1e-12);
}

TEST(PushBalance, AForceIsSteadyOnceItHasStayed) {
  PushBalance balance({}, kPeriod);
  const PushOptions options;
  balance.update(loaded(Vec3(50.0, 0.0, 0.0), Vec3::Zero()), standing(), kHeight);
  EXPECT_FALSE(balance.is_steady());
  for (double t = 0.0; t < 5.0 * options.settling_time; t += kPeriod)
    balance.update(loaded(Vec3(50.0, 0.0, 0.0), Vec3::Zero()), standing(), kHeight);
  EXPECT_TRUE(balance.is_steady());
  balance.update(loaded(Vec3::Zero(), Vec3::Zero()), standing(), kHeight);
  EXPECT_FALSE(balance.is_steady()) << "nor when it ends";
}

TEST(PushBalance, WhatIsNoNumberIsNoLoad) {
  const PushBalance balance = after(loaded(Vec3::Constant(kNaN), Vec3::Zero()));
  EXPECT_FALSE(balance.is_pushed());
  EXPECT_EQ(balance.shift(), Vec2::Zero());
}

}  // namespace
}  // namespace surefoot::gaits
