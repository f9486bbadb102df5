#include "surefoot/gaits/parts/calibration_schedule.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace surefoot::gaits {
namespace {

constexpr double kPeriod = 0.0025;  // [s]
constexpr CalibrationOptions kOptions{.duration = 2.0, .settle = 0.5};
constexpr double kCalibration = 5.5;  // from begin to end [s]

/// A schedule whose robot may begin as soon as it rests.
struct Bench {
  Bench() { schedule.begin(0.0); }

  void run(double until) {
    while (time < until - 0.5 * kPeriod) {
      time += kPeriod;
      if (begins) schedule.begin(time);
      schedule.update(time, asked, !is_disturbed);
      if (const PlanEvent event = schedule.take_end(); event != PlanEvent::none) {
        told.push_back(event);
      }
      begins = schedule.is_wanted() && !schedule.is_going_on() && rests;
      begun += begins ? 1 : 0;
    }
  }
  /// Disturbs the turn of a calibration that began at `begin`, and lets it end.
  void disturb(double begin) {
    run(begin + 1.0);
    is_disturbed = true;
    run(begin + 1.1);
    is_disturbed = false;
    run(begin + kCalibration + 0.1);
  }

  CalibrationSchedule schedule{kOptions};
  double time = 0.0;
  bool asked = false, is_disturbed = false, rests = false, begins = false;
  int begun = 0;  // after the first
  std::vector<PlanEvent> told;
};

TEST(CalibrationSchedule, OneThatWasNotDisturbedIsDoneOnce) {
  Bench bench;
  bench.rests = true;
  bench.run(30.0);
  EXPECT_EQ(bench.begun, 0);
  EXPECT_FALSE(bench.schedule.is_due());
  EXPECT_TRUE(bench.told.empty());
}

TEST(CalibrationSchedule, OneThatWasDisturbedIsDoneOnceMore) {
  Bench bench;
  bench.disturb(0.0);
  EXPECT_EQ(bench.told, std::vector<PlanEvent>{PlanEvent::calibration_disturbed});
  EXPECT_TRUE(bench.schedule.is_wanted());
  EXPECT_EQ(bench.schedule.stage(), CalibrationStage::settling) << "it does not walk off";
  bench.rests = true;
  bench.run(30.0);
  EXPECT_EQ(bench.begun, 1);
  EXPECT_FALSE(bench.schedule.is_due());
}

TEST(CalibrationSchedule, NotWhereItKnowsWhatItIsForAllTheSame) {
  Bench bench;
  bench.schedule.tell_known(true);
  bench.disturb(0.0);
  EXPECT_FALSE(bench.schedule.is_wanted());
  EXPECT_TRUE(bench.told.empty());
}

TEST(CalibrationSchedule, ARepeatThatCannotBeginIsGivenUp) {
  Bench bench;
  bench.disturb(0.0);
  bench.run(30.0);
  EXPECT_EQ(bench.told.back(), PlanEvent::calibration_given_up);
  EXPECT_FALSE(bench.schedule.is_due());
}

TEST(CalibrationSchedule, WhatWasAskedForWaitsAsLongAsItHasTo) {
  for (const bool is_asked_during_it : {false, true}) {
    Bench bench;
    if (is_asked_during_it) {
      bench.run(0.7);
      bench.asked = true;
    }
    bench.disturb(0.0);
    bench.asked = true;
    bench.run(60.0);
    EXPECT_TRUE(bench.schedule.is_wanted()) << is_asked_during_it;
    bench.rests = true;
    bench.run(61.0);
    EXPECT_EQ(bench.begun, 1) << is_asked_during_it;
  }
}

TEST(CalibrationSchedule, ARobotThatIsAskedToMeanwhileDoesNotWalkOffEither) {
  Bench bench;
  bench.run(0.7);
  bench.asked = true;
  bench.disturb(0.0);
  bench.run(kCalibration + 3.0);
  EXPECT_TRUE(bench.schedule.is_wanted());
  EXPECT_EQ(bench.schedule.stage(), CalibrationStage::settling);
}

TEST(CalibrationSchedule, TicksThatAreMissingDisturbIt) {
  for (const int missing : {3, 8}) {
    Bench bench;
    bench.run(1.0);
    bench.time += missing * kPeriod;
    bench.run(kCalibration + 0.1);
    EXPECT_EQ(bench.schedule.is_wanted(), missing == 8) << missing;
  }
}

TEST(CalibrationSchedule, TellsThatOneWaitsEveryTenSeconds) {
  Bench bench;
  bench.run(kCalibration + 1.0);
  bench.asked = true;
  int told = 0;
  for (double until = bench.time; until < 46.0; until += kPeriod) {
    bench.run(until);
    told += bench.schedule.take_waiting() == PlanEvent::calibration_waits ? 1 : 0;
  }
  EXPECT_EQ(told, 3);
}

TEST(CalibrationSchedule, ASwitchThatIsOnFromTheBeginningAsksForNothing) {
  CalibrationSchedule schedule(kOptions);
  schedule.expect_switch(true);
  schedule.begin(0.0);
  schedule.update(0.0, true, true);
  EXPECT_FALSE(schedule.is_wanted());
}

TEST(CalibrationSchedule, ASmallerRobotIsWaitedForLessLong) {
  Bench bench;
  bench.schedule = CalibrationSchedule(kOptions, Scale{.length = 0.25});
  bench.schedule.begin(0.0);
  bench.run(kCalibration);
  bench.asked = true;
  bench.run(kCalibration + 4.9);
  EXPECT_EQ(bench.schedule.take_waiting(), PlanEvent::none);
  bench.run(kCalibration + 5.1);
  EXPECT_EQ(bench.schedule.take_waiting(), PlanEvent::calibration_waits);
}

}  // namespace
}  // namespace surefoot::gaits
