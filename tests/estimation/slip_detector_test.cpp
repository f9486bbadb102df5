#include "surefoot/estimation/slip_detector.hpp"

#include "surefoot/math/rotation.hpp"
#include "tests/support/random_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

using test::Random;

constexpr double kPeriod = 0.0025;
constexpr PerLeg<bool> kAll{true, true, true, true};
const Vec3 kUp = Vec3::UnitZ();

/// Feet with velocities and forces as a test wants them.
struct Feet {
  Feet() {
    for (Vec3& force : state.foot_force) force = Vec3(0.0, 0.0, 75.0);
    state.slips.fill(true);
    state.slip_velocity.fill(Vec3::Constant(7.0));
    run(0.2);
  }
  void tick() { detector.update(dynamics, stands, normal, state); }
  void run(double duration) {
    for (int i = 0; i < std::lround(duration / kPeriod); ++i) tick();
  }
  /// Ticks until this foot is believed to slide, at most 100.
  int ticks_until_slip(Leg leg) {
    int ticks = 0;
    while (!state.slips[index(leg)] && ticks < 100) {
      tick();
      ++ticks;
    }
    return ticks;
  }
  [[nodiscard]] Vec3& velocity(Leg leg) { return dynamics.contact[index(leg)].v; }
  [[nodiscard]] bool slips(Leg leg) const { return state.slips[index(leg)]; }
  [[nodiscard]] int count() const {
    return static_cast<int>(std::ranges::count(state.slips, true));
  }

  SlipDetector detector{SlipOptions{}, kPeriod};
  model::Dynamics dynamics;
  PerLeg<bool> stands = kAll;
  Vec3 normal = kUp;
  RobotState state;
};

TEST(SlipDetector, AFootThatSlidesIsFoundWithin20Milliseconds) {
  for (const Leg leg : kLegs) {
    Feet feet;
    EXPECT_EQ(feet.count(), 0);
    feet.velocity(leg) = {0.12, -0.12, 0.0};
    EXPECT_LE(feet.ticks_until_slip(leg), 8);
    EXPECT_EQ(feet.count(), 1);
    feet.run(0.1);
    EXPECT_LT((feet.state.slip_velocity[index(leg)] - feet.velocity(leg)).norm(), 1e-3);
  }
}

TEST(SlipDetector, TurnsWithTheRobot) {
  const auto found = [](double heading) {
    Feet feet;
    const Mat3 R = rotation_about_z(heading);
    feet.dynamics.base_rotation.R = R;
    feet.stands[index(Leg::RH)] = false;
    feet.velocity(Leg::LF) = R * Vec3(-0.09, 0.07, 0.0);  // medians along W's axes find no slip
    feet.velocity(Leg::RF) = R * Vec3(-0.06, 0.04, 0.0);
    feet.velocity(Leg::LH) = R * Vec3(-0.10, 0.01, 0.0);
    feet.run(0.2);
    return feet.state.slips;
  };
  constexpr PerLeg<bool> kLeftFront{true, false, false, false};
  for (const double heading : {0.0, 0.4, kPi / 4.0, -2.0}) EXPECT_EQ(found(heading), kLeftFront);
}

TEST(SlipDetector, OneThatSlidesMakesNoOtherSlideBeItOnThreeFeet) {
  for (const Leg air : {Leg::LF, Leg::RH}) {
    Feet feet;
    feet.stands[index(air)] = false;
    feet.velocity(air) = {1.0, 0.5, 0.3};
    feet.velocity(Leg::RF) = {0.5, 0.2, 0.0};
    feet.run(0.1);
    EXPECT_TRUE(feet.slips(Leg::RF));
    EXPECT_EQ(feet.count(), 1);
  }
}

TEST(SlipDetector, OfTwoFeetTheOneThatMovesSlides) {
  Feet feet;
  feet.stands[index(Leg::LF)] = feet.stands[index(Leg::RH)] = false;
  feet.velocity(Leg::RF) = {0.5, 0.2, 0.0};
  feet.run(0.1);
  EXPECT_TRUE(feet.slips(Leg::RF));
  EXPECT_EQ(feet.count(), 1);
  feet.velocity(Leg::LH) = feet.velocity(Leg::RF);
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 0) << "the base velocity is wrong";
}

TEST(SlipDetector, AFootSlidesAgainstTheOthersNotAgainstTheBelief) {
  Feet feet;
  for (const Leg leg : kLegs) feet.velocity(leg) = {0.2, 0.0, 0.0};
  feet.run(0.2);
  EXPECT_EQ(feet.count(), 0) << "the base velocity is wrong";
  feet.velocity(Leg::LF) = {0.5, 0.0, 0.0};
  feet.run(0.2);
  EXPECT_EQ(feet.count(), 1);
  EXPECT_TRUE(feet.slips(Leg::LF));
  EXPECT_LT((feet.state.slip_velocity[index(Leg::LF)] - Vec3(0.3, 0.0, 0.0)).norm(), 1e-3);
  EXPECT_LT(feet.state.slip_velocity[index(Leg::RF)].norm(), 1e-3);
}

TEST(SlipDetector, WhereHardlyAFootStandsStillTheBeliefIsWrong) {
  Feet feet;
  feet.velocity(Leg::LF) = {0.5, 0.0, 0.0};
  feet.velocity(Leg::RF) = {-0.5, 0.0, 0.0};
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 2);
  feet.velocity(Leg::LH) = {0.0, 0.5, 0.0};
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 0);
  feet.velocity(Leg::LH).setZero();
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 2);
}

TEST(SlipDetector, OfSixFeetThreeMustStandStill) {
  SlipDetector detector(SlipOptions{}, kPeriod);
  model::Dynamics dynamics(18, 0, kMaxLegs);
  const PerLeg<bool> stands(kMaxLegs, true);
  RobotState state;
  state.size_legs(kMaxLegs);
  state.foot_force = PerLeg<Vec3>(kMaxLegs, Vec3(0.0, 0.0, 75.0));
  const auto sliding = [&](std::initializer_list<Leg> legs) {
    double direction = 0.5;
    for (const Leg leg : legs) dynamics.contact[index(leg)].v.x() = direction = -direction;
    for (int i = 0; i < 100; ++i) detector.update(dynamics, stands, kUp, state);
    return std::ranges::count(state.slips, true);
  };
  EXPECT_EQ(sliding({Leg{0}, Leg{3}, Leg{5}}), 3);
  EXPECT_EQ(sliding({Leg{0}, Leg{3}, Leg{5}, Leg{2}}), 0);
}

TEST(SlipDetector, WhatMovesAlongTheNormalDoesNotSlide) {
  Feet feet;
  feet.normal = Vec3(0.3, 0.1, 1.0).normalized();
  feet.velocity(Leg::LH) = 0.3 * feet.normal;
  feet.run(0.2);
  EXPECT_EQ(feet.count(), 0);
}

TEST(SlipDetector, AShortOrSlowMotionIsNoSlip) {
  Feet feet;
  feet.velocity(Leg::LF) = {0.2, 0.0, 0.0};
  feet.run(2 * kPeriod);
  feet.velocity(Leg::LF).setZero();
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 0);
  feet.velocity(Leg::LF) = {0.9 * SlipOptions{}.begin_speed, 0.0, 0.0};
  feet.run(0.5);
  EXPECT_EQ(feet.count(), 0);
}

TEST(SlipDetector, BetweenTheThresholdsItStaysAsItWas) {
  const SlipOptions options;
  Feet feet;
  feet.velocity(Leg::LF) = {2.0 * options.begin_speed, 0.0, 0.0};
  feet.run(0.1);
  feet.velocity(Leg::LF) = {0.5 * (options.begin_speed + options.end_speed), 0.0, 0.0};
  feet.run(0.5);
  EXPECT_TRUE(feet.slips(Leg::LF));
  feet.velocity(Leg::LF).setZero();
  feet.run(options.end_duration + 0.02);
  EXPECT_FALSE(feet.slips(Leg::LF));
}

TEST(SlipDetector, FeetThatCarryLittleOrHaveJustComeDownAreNotJudged) {
  Feet feet;
  feet.state.foot_force[0] = Vec3(0.0, 0.0, 10.0);
  feet.velocity(Leg::LF) = {0.5, 0.0, 0.0};
  feet.run(0.1);
  EXPECT_EQ(feet.count(), 0);
  feet.velocity(Leg::LF).setZero();
  feet.stands[index(Leg::RF)] = false;
  feet.tick();
  feet.stands = kAll;
  feet.velocity(Leg::RF) = {0.5, 0.0, 0.0};
  feet.run(SlipOptions{}.settle - kPeriod);
  EXPECT_EQ(feet.count(), 0);
  feet.run(0.05);
  EXPECT_TRUE(feet.slips(Leg::RF));
}

TEST(SlipDetector, ANumberThatIsNoneDoesNotStayInTheFilter) {
  Feet feet;
  feet.velocity(Leg::RH) = Vec3::Constant(kNaN);
  feet.tick();
  feet.velocity(Leg::RH).setZero();
  feet.tick();
  EXPECT_EQ(feet.count(), 0);
  for (const Vec3& velocity : feet.state.slip_velocity) EXPECT_TRUE(velocity.allFinite());
}

TEST(SlipDetector, TheSameInGivesTheSameOut) {
  Feet one, two;
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    for (const Leg leg : kLegs) one.velocity(leg) = two.velocity(leg) = random.vector(0.3);
    one.tick();
    two.tick();
    ASSERT_EQ(one.state.slips, two.state.slips);
    ASSERT_EQ(one.state.slip_velocity, two.state.slip_velocity);
  }
}

}  // namespace
}  // namespace surefoot::estimation
