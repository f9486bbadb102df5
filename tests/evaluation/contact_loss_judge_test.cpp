#include "surefoot/evaluation/contact_loss_judge.hpp"

#include <gtest/gtest.h>

namespace surefoot::evaluation {
namespace {

constexpr double kPeriod = 0.0025;

/// A foot among three that stand.
struct Feet {
  Feet() {
    for (simulation::TrueContact& foot : truth.feet) foot.touched = true;
    ticks(100, true, LegPhase::stance);
  }
  void ticks(int count, bool touches, LegPhase phase) {
    for (int i = 0; i < count; ++i) {
      truth.feet[2].touched = touches;
      plan.feet[2].phase = phase;
      judge.add(truth, plan);
      truth.time += kPeriod;
    }
  }
  [[nodiscard]] Metrics metrics() const {
    Metrics result;
    judge.write(result);
    return result;
  }
  simulation::GroundTruth truth;
  MotionPlan plan;
  ContactLossJudge judge;
};

void expect_counts(const Metrics& metrics, int noticed, int missed, int wrong) {
  EXPECT_EQ(metrics.contact_losses_noticed, noticed);
  EXPECT_EQ(metrics.contact_losses_missed, missed);
  EXPECT_EQ(metrics.contact_losses_false, wrong);
}

TEST(ContactLossJudge, ALossIsNoticedWhenTheFootSearches) {
  Feet feet;
  feet.ticks(12, false, LegPhase::stance);
  feet.ticks(40, false, LegPhase::search);
  feet.ticks(40, true, LegPhase::stance);
  expect_counts(feet.metrics(), 1, 0, 0);
  EXPECT_NEAR(feet.metrics().contact_loss_latency_p95_s, 13 * kPeriod, 1e-9);
}

TEST(ContactLossJudge, ABounceIsNoLoss) {
  Feet feet;
  feet.ticks(15, false, LegPhase::stance);
  feet.ticks(40, true, LegPhase::stance);
  expect_counts(feet.metrics(), 0, 0, 0);
}

TEST(ContactLossJudge, AFootThatTouchesAgainUnnoticedWasMissed) {
  Feet feet;
  feet.ticks(30, false, LegPhase::stance);
  feet.ticks(40, true, LegPhase::stance);
  expect_counts(feet.metrics(), 0, 1, 0);
}

TEST(ContactLossJudge, AFootThatLiftsAsPlannedAfterItsLossWasMissed) {
  Feet feet;
  feet.ticks(30, false, LegPhase::stance);
  feet.ticks(20, false, LegPhase::unloading);
  feet.ticks(20, false, LegPhase::swing);
  expect_counts(feet.metrics(), 0, 1, 0);
}

TEST(ContactLossJudge, AFootOnTheGroundThatSearchesIsFalse) {
  Feet feet;
  feet.ticks(1, true, LegPhase::search);
  feet.ticks(20, false, LegPhase::search);
  expect_counts(feet.metrics(), 0, 0, 1);
}

// A foot that has touched down a tick before the plan lets it stand has not lost anything.
TEST(ContactLossJudge, WhatASwingOrASearchDoesInTheAirDoesNotCount) {
  Feet feet;
  feet.ticks(20, false, LegPhase::unloading);
  feet.ticks(100, false, LegPhase::swing);
  feet.ticks(100, false, LegPhase::search);
  feet.ticks(10, false, LegPhase::stance);
  feet.ticks(40, true, LegPhase::stance);
  expect_counts(feet.metrics(), 0, 0, 0);
}

TEST(ContactLossJudge, ALargerRobotsBouncesMayBeLonger) {
  Feet feet;
  feet.judge = ContactLossJudge(Scale{.length = 4.0});
  feet.ticks(30, false, LegPhase::stance);
  feet.ticks(40, true, LegPhase::stance);
  expect_counts(feet.metrics(), 0, 0, 0);
}

}  // namespace
}  // namespace surefoot::evaluation
