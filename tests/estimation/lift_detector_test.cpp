#include "surefoot/estimation/lift_detector.hpp"

#include "surefoot/signals/sensor_reading.hpp"
#include "tests/support/malloc_counter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr double kWeight = 300.0;   // [N]

/// Readings of a robot that stands for a second before the test begins.
struct Felt {
  Felt() { feel(1.0, {75.0, 75.0, 75.0, 75.0}, kGravity); }

  void feel(double duration, const std::array<double, kNumLegs>& forces, double acceleration) {
    for (std::size_t k = 0; k < kNumLegs; ++k) force[k] = Vec3(0.0, 0.0, forces[k]);
    accelerometer = Vec3(0.0, 0.0, acceleration);
    run(duration);
  }
  void run(double duration) {
    for (int i = 0; i < static_cast<int>(std::lround(duration / kPeriod)); ++i) {
      detector.update(kWeight, force, accelerometer);
      was_lifted = was_lifted || detector.is_lifted();
    }
  }

  LiftDetector detector{kPeriod};
  PerLeg<Vec3> force{};
  Vec3 accelerometer = Vec3::Zero();
  bool was_lifted = false;
};

TEST(LiftDetector, ARobotIsLiftedThatFeelsItsWeightForMoreThanAMomentButNotOnItsFeet) {
  const Felt standing;
  EXPECT_TRUE(standing.detector.is_down());
  EXPECT_FALSE(standing.was_lifted);
  Felt held, shortly, falling, tumbling;
  held.feel(0.2, {}, kGravity);
  EXPECT_TRUE(held.detector.is_lifted());
  EXPECT_FALSE(held.detector.is_down());
  shortly.feel(0.05, {}, kGravity);
  EXPECT_FALSE(shortly.was_lifted);
  falling.feel(0.5, {}, 0.0);
  EXPECT_FALSE(falling.was_lifted);
  for (int i = 0; i < 5; ++i) {  // falls, lands on two feet, falls on
    tumbling.feel(0.15, {}, 0.5);
    tumbling.feel(0.03, {400.0, 0.0, 300.0, 0.0}, 23.0);
  }
  EXPECT_FALSE(tumbling.was_lifted);
}

TEST(LiftDetector, OneIsHeldThatHasLessThanHalfOfItsWeightOnItsFeet) {
  Felt robot;
  robot.feel(1.0, {0.0, 100.0, 70.0, 0.0}, kGravity);
  EXPECT_FALSE(robot.was_lifted);
  robot.feel(0.2, {0.0, 70.0, 50.0, 0.0}, kGravity);
  EXPECT_TRUE(robot.was_lifted);
}

// Torques with a common error give forces with an error.
TEST(LiftDetector, ForcesThatCancelAreForces) {
  Felt robot;
  robot.feel(1.0, {60.0, -60.0, 60.0, -60.0}, kGravity);
  EXPECT_FALSE(robot.was_lifted);
}

TEST(LiftDetector, OneThatSwingsOnACraneStaysLifted) {
  Felt robot;
  robot.feel(0.2, {}, kGravity);
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.5 * std::sin(0.01 * i);
    robot.accelerometer =
        (1.0 + 0.2 * std::sin(0.02 * i)) * kGravity * Vec3(std::sin(angle), 0.0, std::cos(angle));
    robot.run(kPeriod);
    ASSERT_TRUE(robot.detector.is_lifted()) << i;
  }
}

TEST(LiftDetector, ItIsDownWhenThreeFeetBearMostOfItForSomeTime) {
  Felt robot;
  robot.feel(1.0, {}, kGravity);
  robot.feel(1.0, {30.0, 30.0, 30.0, 30.0}, kGravity);
  EXPECT_FALSE(robot.detector.is_down());
  robot.feel(1.0, {150.0, 0.0, 0.0, 150.0}, kGravity);
  EXPECT_FALSE(robot.detector.is_down());
  robot.feel(0.1, {100.0, 100.0, 0.0, 100.0}, kGravity);
  EXPECT_FALSE(robot.detector.is_down());
  robot.feel(0.1, {100.0, 100.0, 0.0, 100.0}, kGravity);
  EXPECT_TRUE(robot.detector.is_down());
}

// Three of six feet can be those of one side.
TEST(LiftDetector, OfSixFeetFourBearTheRobot) {
  LiftDetector detector(kPeriod);
  const auto feel = [&](std::initializer_list<double> forces) {
    PerLeg<Vec3> force(kMaxLegs, Vec3::Zero());
    std::size_t k = 0;
    for (const double f : forces) force[k++].z() = f;
    for (int i = 0; i < 200; ++i) detector.update(kWeight, force, Vec3(0.0, 0.0, kGravity));
    return detector.is_down();
  };
  EXPECT_FALSE(feel({100.0, 0.0, 100.0, 0.0, 100.0, 0.0}));
  EXPECT_TRUE(feel({75.0, 0.0, 75.0, 75.0, 75.0, 0.0}));
  EXPECT_TRUE(detector.bears(Leg{4}));
}

TEST(LiftDetector, WhereNumbersAreMissingNothingChanges) {
  Felt robot;
  robot.force.fill(Vec3::Constant(kNaN));
  robot.run(1.0);
  robot.force.fill(Vec3::Zero());
  robot.accelerometer.setConstant(kNaN);
  const test::MallocCounter counter;
  robot.run(1.0);
  EXPECT_EQ(counter.count(), 0U);
  EXPECT_TRUE(robot.detector.is_down());
}

}  // namespace
}  // namespace surefoot::estimation
