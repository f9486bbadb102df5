#include "surefoot/gaits/rhythm/driven_com.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::gaits {
namespace {

constexpr double kTick = 0.0025;

TEST(DrivenCom, reaches_the_velocity_with_the_acceleration_and_no_faster) {
  DrivenCom com;
  com.start(Vec2::Zero(), Vec2::Zero());
  for (int i = 0; i < 200; ++i) com.update({1.0, 0.0}, 0.0, 1.0, 1e3, Vec2::Zero(), kTick);
  EXPECT_NEAR(com.plan().v.x(), 0.5, 1e-9);
  EXPECT_NEAR(com.plan().a.x(), 1.0, 1e-9);
  EXPECT_NEAR(com.plan().p.x(), 0.125, 1e-3);
  for (int i = 0; i < 400; ++i) com.update({1.0, 0.0}, 0.0, 1.0, 1e3, Vec2::Zero(), kTick);
  EXPECT_NEAR(com.plan().v.x(), 1.0, 1e-9);
  EXPECT_NEAR(com.plan().a.x(), 0.0, 1e-9);
}

TEST(DrivenCom, stays_within_its_leash_of_a_robot_that_cannot_follow) {
  DrivenCom com;
  com.start(Vec2::Zero(), Vec2::Zero());
  const Vec2 stuck(0.3, -0.2);
  for (int i = 0; i < 1000; ++i) com.update({1.0, 0.5}, 0.0, 1.0, 0.05, stuck, kTick);
  EXPECT_NEAR((com.plan().p - stuck).norm(), 0.05, 1e-9);
}

TEST(DrivenCom, asks_for_the_centripetal_acceleration_in_a_turn) {
  DrivenCom com;
  com.start(Vec2::Zero(), {1.0, 0.0});
  double yaw = 0.0;
  for (int i = 0; i < 400; ++i) {
    yaw += kTick * 0.8;
    com.update({std::cos(yaw), std::sin(yaw)}, 0.8, 5.0, 1e3, Vec2::Zero(), kTick);
  }
  const Vec2 left(-std::sin(yaw), std::cos(yaw));
  EXPECT_NEAR(com.plan().a.dot(left), 0.8, 0.02);
  EXPECT_NEAR(com.plan().v.norm(), 1.0, 0.01);
}

}  // namespace
}  // namespace surefoot::gaits
