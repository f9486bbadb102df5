// When the walk calibrates itself, and when it does so once more.
#include "tests/gaits/watch.hpp"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace surefoot::gaits {
namespace {

TEST(PlannerCalibration, CalibratesNoHigherThanNominally) {
  PlannerOptions options;
  options.calibration.duration = 2.0;
  test::Puppet puppet(options);
  puppet.user = {.height = 0.05};
  bool calibrated = false;
  puppet.run(8.0, [&] {
    if (puppet.plan().calibration == CalibrationStage::none) return;
    calibrated = true;
    EXPECT_LT(puppet.plan().torso.height, options.stance.height + 1e-6);
  });
  EXPECT_TRUE(calibrated);
  EXPECT_GT(puppet.plan().torso.height, options.stance.height + 0.01);
  EXPECT_TRUE(puppet.happenings().empty());
}

// A calibration finds that feet are where nobody thought.
TEST(PlannerCalibration, AfterACalibrationTheGroundIsWhereTheFeetAreThen) {
  PlannerOptions options;
  options.calibration.duration = 2.0;
  test::Puppet puppet(options);
  puppet.run(1.0);
  ASSERT_EQ(puppet.plan().calibration, CalibrationStage::turning);
  puppet.ground = test::level_ground(-0.01);
  for (const Leg leg : kLegs) puppet.place(leg, puppet.foot(leg).head<2>());
  puppet.run(8.0);
  ASSERT_EQ(puppet.plan().calibration, CalibrationStage::none);
  EXPECT_NEAR(puppet.plan().terrain_point.z(), -0.01, 1e-6);
}

TEST(PlannerCalibration, AskedToCalibrateItStandsDoesSoOnceAndWalksOn) {
  PlannerOptions options;
  options.calibration.duration = 4.0;
  test::Puppet puppet(options);
  puppet.user = test::walking(0.05);
  puppet.run(20.0);
  ASSERT_GT(puppet.planner().steps_taken(), 4);
  puppet.user.calibrate = true;  // and stays so: it counts once
  int turning = 0, asked = 0;
  puppet.run(15.0, [&] {
    asked += puppet.planner().restarts() ? 1 : 0;
    EXPECT_TRUE(!puppet.planner().restarts() || puppet.plan().num_contacts() == 4);
    turning += puppet.plan().calibration == CalibrationStage::turning ? 1 : 0;
  });
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(puppet.happenings(PlanEvent::calibration).size(), 1u);
  EXPECT_NEAR(turning * test::Puppet::kPeriod, 4.0, 0.01);
  const int steps = puppet.planner().steps_taken();
  puppet.run(6.0);
  EXPECT_GT(puppet.planner().steps_taken(), steps + 3) << "and walks on";
  puppet.user.calibrate = false;
  puppet.run(1.0);
  puppet.user.calibrate = true;
  puppet.run(12.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::calibration).size(), 2u) << "asked for again";
}

TEST(PlannerCalibration, TellsAgainAndAgainThatACalibrationWaitsForARobotThatNeverRests) {
  test::Puppet puppet;
  puppet.run(3.0);
  puppet.drift = 0.05;
  puppet.user.calibrate = true;
  const double asked_at = puppet.time();
  puppet.run(35.0);
  EXPECT_TRUE(puppet.happenings(PlanEvent::calibration).empty());
  const std::vector<test::Happening> told = puppet.happenings(PlanEvent::calibration_waits);
  ASSERT_EQ(told.size(), 3u);
  EXPECT_GT(told.front().time, asked_at + 5.0) << "not before a walk would have ended";
  puppet.drift = 0.0;
  puppet.run(2.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::calibration).size(), 1u) << "once it rests";
  puppet.run(35.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::calibration_waits).size(), 3u);
}

/// A robot that calibrates itself for 9.5 s and is told to walk, with something done to it `from` …
/// `to` [s].
struct Disturbed {
  Disturbed(double from, double to, const std::function<void(test::Puppet&, bool)>& disturb) {
    puppet.user = test::walking(0.05);
    puppet.run(70.0, [&] {
      disturb(puppet, puppet.time() > from && puppet.time() < to);
      const CalibrationStage stage = puppet.plan().calibration;
      turning += stage == CalibrationStage::turning ? test::Puppet::kPeriod : 0.0;
      none_before_end = none_before_end || (stage == CalibrationStage::none && !has_ended());
    });
  }

  static PlannerOptions options() {
    PlannerOptions result;
    result.calibration.duration = 6.0;
    return result;
  }
  std::size_t count(PlanEvent event) const { return puppet.happenings(event).size(); }
  double first(PlanEvent event) const { return puppet.happenings(event).front().time; }
  /// As many have begun as were to be, and the last one is over.
  bool has_ended() const {
    return puppet.time() > 9.5 + 1e-9 &&
           count(PlanEvent::calibration) == count(PlanEvent::calibration_disturbed) &&
           (count(PlanEvent::calibration) == 0 ||
            puppet.time() > puppet.happenings(PlanEvent::calibration).back().time + 9.5);
  }

  test::Puppet puppet{options()};
  double turning = 0.0;  // in all [s]
  bool none_before_end = false;
};

void push_sideways(test::Puppet& puppet, bool now) {
  puppet.push = now ? Vec3(20.0, 0.0, 0.0) : Vec3(0.0, 0.0, 0.0);
}

void press_down(test::Puppet& puppet, bool now) { puppet.push.z() = now ? -60.0 : 0.0; }

void slide_a_foot(test::Puppet& puppet, bool now) {
  puppet.slide[index(Leg::RF)] = now ? Vec2(30.0, 0.0) : Vec2(0.0, 0.0);
}

TEST(PlannerCalibration, ACalibrationThatIsDisturbedIsDoneOnceMoreBeforeTheWalk) {
  for (const auto& [disturb, from] : std::vector<std::pair<void (*)(test::Puppet&, bool), double>>{
           {push_sideways, 3.0}, {push_sideways, 7.5}, {slide_a_foot, 3.0}}) {
    const Disturbed once(from, from + 0.5, disturb);
    ASSERT_EQ(once.count(PlanEvent::calibration_disturbed), 1u) << from;
    ASSERT_EQ(once.count(PlanEvent::calibration), 1u) << from;
    EXPECT_EQ(once.count(PlanEvent::calibration_given_up), 0u) << from;
    EXPECT_NEAR(once.turning, 12.0, 0.02) << from;
    EXPECT_FALSE(once.none_before_end) << "or what it does not know yet is judged";
    EXPECT_LT(once.first(PlanEvent::calibration_disturbed), once.first(PlanEvent::calibration));
    EXPECT_GT(once.first(PlanEvent::lift_off), once.first(PlanEvent::calibration) + 9.0);
  }
}

TEST(PlannerCalibration, ACalibrationThatIsAlwaysDisturbedDoesNotKeepTheRobotFromWalking) {
  Disturbed leaned_on(1.0, 1e3, push_sideways);
  EXPECT_EQ(leaned_on.count(PlanEvent::calibration_disturbed), 2u);
  EXPECT_EQ(leaned_on.count(PlanEvent::calibration), 2u);
  ASSERT_EQ(leaned_on.count(PlanEvent::calibration_given_up), 1u);
  EXPECT_NEAR(leaned_on.turning, 18.0, 0.02);
  EXPECT_GT(leaned_on.first(PlanEvent::lift_off), leaned_on.first(PlanEvent::calibration_given_up));
  leaned_on.puppet.user.calibrate = true;
  leaned_on.puppet.run(60.0);
  EXPECT_EQ(leaned_on.count(PlanEvent::calibration_given_up), 2u) << "asked for, it tries anew";
  EXPECT_EQ(leaned_on.count(PlanEvent::calibration), 5u);
}

TEST(PlannerCalibration, ACalibrationIsNotRepeatedWhileTheRobotSwaysNorWaitedForForEver) {
  const auto sway = [](test::Puppet& puppet, bool now) {
    push_sideways(puppet, puppet.time() > 3.0 && puppet.time() < 3.5);
    puppet.drift = now ? 0.2 * std::sin(2.0 * kPi * puppet.time()) : 0.0;
  };
  const Disturbed shortly(8.0, 14.0, sway);
  ASSERT_EQ(shortly.count(PlanEvent::calibration), 1u);
  EXPECT_GT(shortly.first(PlanEvent::calibration), 14.9) << "when it has been at rest for 1 s";
  const Disturbed for_long(8.0, 1e3, sway);
  EXPECT_EQ(for_long.count(PlanEvent::calibration), 0u);
  EXPECT_EQ(for_long.count(PlanEvent::calibration_waits), 0u) << "or it would wait on";
  ASSERT_EQ(for_long.count(PlanEvent::calibration_given_up), 1u);
  EXPECT_GT(for_long.first(PlanEvent::lift_off), for_long.first(PlanEvent::calibration_given_up));
}

TEST(PlannerCalibration, WhatDoesNotDisturbACalibrationDoesNotRepeatIt) {
  const Disturbed known_all_the_same(3.0, 3.5, [](test::Puppet& puppet, bool now) {
    push_sideways(puppet, now);
    puppet.calibration_known = true;
  });
  EXPECT_NEAR(known_all_the_same.turning, 6.0, 0.02) << "it knows what it is for all the same";
  const Disturbed laden(1.0, 1e3, press_down);
  EXPECT_NEAR(laden.turning, 6.0, 0.02) << "a payload";
  const Disturbed later(9.6, 12.0, push_sideways);
  EXPECT_NEAR(later.turning, 6.0, 0.02) << "when it is over";
  for (const Disturbed* robot : {&known_all_the_same, &laden, &later}) {
    EXPECT_EQ(robot->count(PlanEvent::calibration_disturbed), 0u);
    EXPECT_GT(robot->count(PlanEvent::lift_off), 0u);
  }
}

TEST(PlannerCalibration, WhileItCalibratesNoStrideIsTooLong) {
  test::Puppet puppet(Disturbed::options());
  puppet.user = test::walking(0.5);
  puppet.run(9.0);
  EXPECT_TRUE(puppet.happenings().empty());
  puppet.run(3.0);
  EXPECT_EQ(puppet.happenings(PlanEvent::slowed).size(), 1u);
}

}  // namespace
}  // namespace surefoot::gaits
