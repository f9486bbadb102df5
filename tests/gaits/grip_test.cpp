#include "surefoot/gaits/parts/grip.hpp"

#include <gtest/gtest.h>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kConfigured = 0.5;
const PerLeg<Vec3> kUp{Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()};

RobotState standing() {
  RobotState state;
  for (Vec3& force : state.foot_force) force = Vec3(30.0, 0.0, 100.0);
  return state;
}

RobotState sliding(Leg leg, const Vec3& force) {
  RobotState state = standing();
  state.slips[index(leg)] = true;
  state.foot_force[index(leg)] = force;
  return state;
}

TEST(Grip, AFootThatSlidesIsGivenLessThanTheRatioAtWhichItDoes) {
  Grip grip(GripOptions{}, kConfigured, kPeriod);
  EXPECT_TRUE(grip.update(sliding(Leg::RF, {0.0, 40.0, 100.0}), kUp));
  EXPECT_TRUE(grip.began());
  EXPECT_NEAR(grip.friction(Leg::RF), 0.7 * 0.4, 1e-12);
  EXPECT_EQ(grip.friction(Leg::LF), kConfigured);
}

TEST(Grip, AnotherGaitBringsItsFrictionButForOneThatTheUserHasSet) {
  GripOptions options;
  Grip grip(options, kConfigured, kPeriod);
  grip.use(options, 0.4);
  EXPECT_EQ(grip.friction(Leg::LF), 0.4);
  grip.use(options, kConfigured);
  EXPECT_EQ(grip.friction(Leg::LF), 0.4);  // recovers as after a slip
  for (int i = 0; i < 4000; ++i) grip.update(standing(), kUp);
  EXPECT_EQ(grip.friction(Leg::LF), kConfigured);
  grip.expect(0.7);
  grip.use(options, 0.4);
  EXPECT_EQ(grip.friction(Leg::LF), 0.7);
}

TEST(Grip, TheRatioIsAboutThePyramidOfTheFoot) {
  Grip grip(GripOptions{}, kConfigured, kPeriod);
  const Vec3 normal = Vec3(0.2, 0.0, 1.0).normalized();
  PerLeg<Vec3> normals = kUp;
  normals[index(Leg::LH)] = normal;
  grip.update(sliding(Leg::LH, 80.0 * normal + 24.0 * Vec3::UnitY()), normals);
  EXPECT_NEAR(grip.friction(Leg::LH), 0.7 * 0.3, 1e-12);
}

TEST(Grip, KeepsToItsLowerLimitAndNeverRisesBySliding) {
  Grip grip(GripOptions{}, kConfigured, kPeriod);
  grip.update(sliding(Leg::LF, {5.0, 0.0, 100.0}), kUp);
  EXPECT_EQ(grip.friction(Leg::LF), GripOptions{}.friction_min);
  grip.update(sliding(Leg::LF, {60.0, 0.0, 100.0}), kUp);
  EXPECT_EQ(grip.friction(Leg::LF), GripOptions{}.friction_min);
}

TEST(Grip, ForcesOfAFootThatHardlyTouchesSayNothing) {
  Grip grip(GripOptions{}, kConfigured, kPeriod);
  grip.update(sliding(Leg::LF, {1.0, 0.0, 5.0}), kUp);
  grip.update(sliding(Leg::LF, Vec3::Constant(kNaN)), kUp);
  EXPECT_EQ(grip.friction(Leg::LF), kConfigured);
}

TEST(Grip, ComesBackAtItsRateToWhatIsConfigured) {
  Grip grip(GripOptions{}, kConfigured, kPeriod);
  grip.update(sliding(Leg::LF, {40.0, 0.0, 100.0}), kUp);
  EXPECT_TRUE(grip.update(standing(), kUp)) << "it stands again";
  EXPECT_FALSE(grip.began());
  for (int i = 1; i < 400; ++i) EXPECT_FALSE(grip.update(standing(), kUp));
  EXPECT_NEAR(grip.friction(Leg::LF), 0.28 + GripOptions{}.recovery * 1.0, 1e-9);
  for (int i = 0; i < 8000; ++i) grip.update(standing(), kUp);
  EXPECT_EQ(grip.friction(Leg::LF), kConfigured);
}

TEST(Grip, TheWalkSlowsDownWhereAFootHasTooLittle) {
  const GripOptions options;
  Grip grip(options, kConfigured, kPeriod);
  EXPECT_EQ(grip.caution(), 1.0);
  grip.update(sliding(Leg::RH, {0.0, 0.0, 100.0}), kUp);
  EXPECT_NEAR(grip.caution(), options.enough / options.friction_min, 1e-12);
}

TEST(Grip, SwitchedOffItBelievesWhatIsConfigured) {
  Grip grip({.enabled = false}, kConfigured, kPeriod);
  EXPECT_FALSE(grip.update(sliding(Leg::RF, {0.0, 40.0, 100.0}), kUp));
  EXPECT_EQ(grip.friction(Leg::RF), kConfigured);
}

}  // namespace
}  // namespace surefoot::gaits
