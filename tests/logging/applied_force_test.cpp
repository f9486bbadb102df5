#include "surefoot/logging/applied_force.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::logging {
namespace {

constexpr double kPeriod = 0.0025;

std::vector<double> on_base(const Vec3& force) {
  std::vector<double> xfrc(6 * 3, 0.0);
  for (int i = 0; i < 3; ++i) xfrc[static_cast<std::size_t>(6 + i)] = force[i];
  xfrc[6 + 5] = 3.0;  // a torque is no force
  return xfrc;
}

Quat turned(double yaw) { return Quat(Eigen::AngleAxisd(yaw, Vec3::UnitZ())); }

TEST(AppliedForce, ItsBeginIsToldWithItsWholeForceAndItsEndWithTheTime) {
  AppliedForceWatch watch;
  std::vector<AppliedForce> begun, ended;
  for (int tick = 0; tick < 40; ++tick) {
    const double share = tick <= 10 || tick > 30 ? 0.0 : (tick == 11 ? 0.2 : 1.0);
    const auto changes = watch.see(kPeriod * tick, on_base(Vec3(0, 50 * share, 0)), turned(0.0));
    begun.insert(begun.end(), changes.begun.begin(), changes.begun.end());
    ended.insert(ended.end(), changes.ended.begin(), changes.ended.end());
    EXPECT_EQ(watch.acting().size(), share > 0.0 ? 1U : 0U);
  }
  ASSERT_EQ(begun.size(), 1U);
  ASSERT_EQ(ended.size(), 1U);
  EXPECT_EQ(begun[0].body, 1U);
  EXPECT_NEAR(begun[0].from, 10 * kPeriod, 1e-12);
  EXPECT_EQ(begun[0].force, Vec3(0, 50, 0));
  EXPECT_NEAR(ended[0].to, 30 * kPeriod, 1e-12);
}

TEST(AppliedForce, OneThatActsAtTheFirstTickOfAllHasNoBeginAndOneOfATickAloneHas) {
  AppliedForceWatch watch;
  for (int tick = 0; tick < 3; ++tick)
    EXPECT_TRUE(watch.see(kPeriod * tick, on_base(Vec3(9, 0, 0)), turned(0.0)).begun.empty());
  EXPECT_EQ(watch.see(3 * kPeriod, on_base(Vec3::Zero()), turned(0.0)).ended.size(), 1U);
  EXPECT_TRUE(watch.see(4 * kPeriod, on_base(Vec3(9, 0, 0)), turned(0.0)).begun.empty());
  const auto changes = watch.see(5 * kPeriod, on_base(Vec3::Zero()), turned(0.0));
  EXPECT_EQ(changes.begun.size(), 1U);
  EXPECT_EQ(changes.ended.size(), 1U);
}

TEST(AppliedForce, ItsDirectionIsThatFromTheRobotsHeading) {
  const auto told = [](const Vec3& force, double yaw) {
    return applied_force_text(applied_forces(0.0, on_base(force), turned(yaw)).at(0), {});
  };
  EXPECT_EQ(told(Vec3(0, 50, 0), 0.0), "50 N, 90° from ahead to the left, on the base");
  EXPECT_EQ(told(Vec3(0, 50, 0), M_PI), "50 N, 90° from ahead to the right, on the base");
  EXPECT_EQ(told(Vec3(0, 50, 0), M_PI / 2), "50 N, 0° from ahead, on the base");
  EXPECT_EQ(told(Vec3(0, -50, 0), M_PI / 2), "50 N, 180° from ahead, on the base");
  EXPECT_EQ(told(Vec3(0, 0, -120), 0.3), "120 N, downwards, on the base");
  EXPECT_EQ(told(Vec3(30, 0, 40), 0.0), "50 N, 0° from ahead and upwards, on the base");
}

TEST(AppliedForce, BodiesHaveTheNamesOfThePhysicsModel) {
  LogHeader header;
  EXPECT_TRUE(body_names(header).empty());
  header.attachments = {{"model.xml", "application/xml",
                         "<worldbody><body name=\"base\" pos=\"0 0 1\"><body name=\"LF_HIP\"/>"
                         "</body><body name=\"RF_HIP\"/></worldbody>"}};
  const std::vector<std::string> names = body_names(header);
  EXPECT_EQ(names, (std::vector<std::string>{"world", "base", "LF_HIP", "RF_HIP"}));
  EXPECT_EQ(body_text(1, names), "the base");
  EXPECT_EQ(body_text(2, names), "LF_HIP");
  EXPECT_EQ(body_text(7, names), "body 7");
}

}  // namespace
}  // namespace surefoot::logging
