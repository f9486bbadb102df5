#include "surefoot/estimation/swing_tare.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kPeriod = 0.0025;
constexpr double kNoLag = 1e9;  // [rad/s]
constexpr PerLeg<bool> kStanding{true, true, true, true};
constexpr PerLeg<bool> kSwingLF{false, true, true, true};
constexpr int kSwing = 160;  // ticks
/// The model explains the bench's leg completely.
constexpr SwingTareOptions kClear{.noise = 0.5};  // [N·m]
constexpr Scale kOneSize{};

/// A robot whose swinging leg LF lacks bias + gain τ + friction q̇ + inertia q̈ in its joints.
struct Bench {
  void tick(const PerLeg<bool>& stands, double extra = 0.0) {
    time += kPeriod;
    for (int j = 0; j < kNumLegJoints; ++j) {
      const double phase = (5.0 + j) * time;
      velocity[j] = 3.0 * std::sin(phase);
      acceleration[j] = 3.0 * (5.0 + j) * std::cos(phase);
      torque[j] = 6.0 * std::sin(1.7 * phase) + 2.0;
    }
    lacking = JointVector::Constant(kNumLegJoints, 0.4) + 0.1 * torque - 0.05 * velocity +
              0.01 * acceleration;
    for (JointVector& stage : stages) {
      stage += (1.0 - std::exp(-lag * kPeriod)) * (lacking - stage);
      lacking = stage;
    }
    tare.update(stands, lacking + JointVector::Constant(kNumLegJoints, extra), torque, velocity,
                acceleration);
  }
  void swings(int count, double extra = 0.0) {
    for (int i = 0; i < count; ++i) {
      for (int t = 0; t < kSwing; ++t) tick(kSwingLF, extra);
      for (int t = 0; t < 40; ++t) tick(kStanding, extra);
    }
  }
  /// Largest of what is left of LF's joints over a swing [N·m].
  double left() {
    double most = 0.0;
    for (int t = 0; t < kSwing; ++t) {
      tick(kSwingLF);
      EXPECT_TRUE(tare.tare().allFinite());
      most = std::max(most, (lacking - tare.tare()).head<3>().cwiseAbs().maxCoeff());
    }
    tick(kStanding);
    return most;
  }

  SwingTare tare{kClear, kNoLag, kPeriod, kOneSize};
  double time = 0.0;
  double lag = kNoLag;  // of the three poles that the lacking torques come by [rad/s]
  std::array<JointVector, 3> stages{JointVector::Zero(kNumLegJoints),
                                    JointVector::Zero(kNumLegJoints),
                                    JointVector::Zero(kNumLegJoints)};
  JointVector torque = JointVector::Zero(kNumLegJoints);
  JointVector velocity = torque, acceleration = torque, lacking = torque;
};

TEST(SwingTare, LearnsWhatASwingingLegLacks) {
  Bench bench;
  const double before = Bench().left();
  bench.swings(4);
  EXPECT_GT(before, 1.0);
  EXPECT_LT(bench.left(), 0.1 * before);
}

// The torque error comes from an observer with a lag; its signals need the same lag.
TEST(SwingTare, LearnsFromWhatAnObserverSays) {
  constexpr double kBandwidth = 250.0;  // [rad/s]
  const auto left_by = [&](double bandwidth_of_tare) {
    Bench bench;
    bench.tare = SwingTare(kClear, bandwidth_of_tare, kPeriod);
    bench.lag = kBandwidth;
    bench.swings(4);
    return bench.left();
  };
  EXPECT_LT(left_by(kBandwidth), 0.4 * left_by(kNoLag));
}

// A few swings must have little effect, otherwise it would learn more than model errors.
TEST(SwingTare, BelievesMoreSwingsMore) {
  Bench bench;
  const double before = bench.left();
  bench.tare = SwingTare({}, kNoLag, kPeriod);
  double last = before;
  for (const int swings : {1, 2, 4, 8}) {
    bench.swings(swings);
    const double left = bench.left();
    EXPECT_LT(left, last) << swings;
    last = left;
  }
  EXPECT_GT(last, 0.1 * before);
  EXPECT_LT(last, 0.2 * before);
}

TEST(SwingTare, SaysNothingFromAPartOfASwing) {
  Bench bench;
  for (int t = 0; t < kSwing; ++t) {
    bench.tick(kSwingLF);
    EXPECT_EQ(bench.tare.tare().norm(), 0.0) << t;
  }
  bench.tick(kStanding);
  bench.tick(kSwingLF);
  EXPECT_NE(bench.tare.tare()[1], 0.0);
}

TEST(SwingTare, SaysNothingOfLegsThatStandNorOfOtherLegs) {
  Bench bench;
  bench.swings(4);
  bench.tick(kStanding);
  EXPECT_EQ(bench.tare.tare(), JointVector(JointVector::Zero(kNumLegJoints)));
  bench.tick(kSwingLF);
  EXPECT_NE(bench.tare.tare()[1], 0.0);
  EXPECT_EQ(bench.tare.tare().tail<9>().norm(), 0.0);
  bench.tick({true, false, true, true});
  EXPECT_EQ(bench.tare.tare().norm(), 0.0);
}

TEST(SwingTare, WhatComesShortlyBeforeATouchdownIsNotLearnt) {
  const SwingTareOptions options;
  Bench bench, disturbed;
  bench.swings(3);
  disturbed.swings(3);
  for (Bench* b : {&bench, &disturbed}) {
    for (int t = 0; t < 80; ++t) b->tick(kSwingLF);
    const int pressed = static_cast<int>(0.9 * options.wait / kPeriod);
    for (int t = 0; t < pressed; ++t) b->tick(kSwingLF, b == &disturbed ? 5.0 : 0.0);
    b->tick(kStanding);
    b->tick(kSwingLF);
  }
  EXPECT_EQ(bench.tare.tare(), disturbed.tare.tare());
}

TEST(SwingTare, ALongSearchForGroundIsNotLearnt) {
  Bench bench;
  bench.swings(3);
  const double known = bench.left();
  for (int t = 0; t < kSwing; ++t) bench.tick(kSwingLF);
  for (int t = 0; t < 800; ++t) bench.tick(kSwingLF, 5.0);
  bench.tick(kStanding);
  EXPECT_NEAR(bench.left(), known, 0.05);
}

TEST(SwingTare, FollowsARobotThatChanges) {
  Bench bench;
  bench.swings(6);
  bench.swings(30, 2.0);
  bench.tick(kSwingLF, 2.0);
  EXPECT_NEAR((bench.lacking + JointVector::Constant(kNumLegJoints, 2.0) - bench.tare.tare())[1],
              0.0, 0.1);
}

TEST(SwingTare, ANotANumberIsNotLearntAndForgottenAtOnce) {
  Bench lacking, signals;
  lacking.swings(3);
  for (int t = 0; t < 80; ++t) lacking.tick(kSwingLF, t == 30 ? std::nan("") : 0.0);
  signals.swings(3);
  const JointVector none = JointVector::Constant(kNumLegJoints, std::nan(""));
  signals.tare.update(kSwingLF, signals.lacking, none, none, none);
  for (int t = 0; t < 10; ++t) {
    signals.tick(kSwingLF);
    EXPECT_TRUE(signals.tare.tare().allFinite()) << t;
  }
  for (Bench* bench : {&lacking, &signals}) {
    bench->tick(kStanding);
    EXPECT_LT(bench->left(), 0.5);
  }
}

TEST(SwingTare, SwitchedOffItSaysNothing) {
  Bench bench;
  bench.tare = SwingTare({.enabled = false}, kNoLag, kPeriod);
  bench.swings(3);
  bench.tick(kSwingLF);
  EXPECT_EQ(bench.tare.tare().norm(), 0.0);
}

}  // namespace
}  // namespace surefoot::estimation
