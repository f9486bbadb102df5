#include "surefoot/control/level_switcher.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/stack_file.hpp"
#include "tests/control/statue.hpp"
#include "tests/support/malloc_counter.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surefoot::control {
namespace {

using test::holds;

constexpr std::size_t kComXy = 4, kTorsoYaw = 7, kTorsoHeight = 8;

StackOptions table_one() { return config::load_stack("terrain_adaptation"); }

TEST(LevelSwitcher, RaisesTheShareFrom0To1OverTheDuration) {
  LevelSwitcher switcher(table_one(), {{.time = 1.0, .remove = {"com_xy"}, .duration = 0.5}});
  EXPECT_FALSE(switcher.update(0.99).is_going_on());
  EXPECT_EQ(switcher.update(1.0).share, 0.0);
  const LevelTransition halfway = switcher.update(1.25);
  EXPECT_TRUE(halfway.is_going_on());
  EXPECT_TRUE(halfway.before[kComXy]);
  EXPECT_FALSE(halfway.after[kComXy]);
  EXPECT_NEAR(halfway.share, 0.5, 1e-12);
  const LevelTransition ended = switcher.update(1.5);
  EXPECT_FALSE(ended.is_going_on());
  EXPECT_FALSE(ended.before[kComXy]);
  EXPECT_TRUE(ended.before[kTorsoYaw]);
}

TEST(LevelSwitcher, EndsASwitchThatBeganBeforeTheClockWasKnown) {
  for (const double first : {kNaN, 1000.0}) {
    LevelSwitcher switcher(table_one(), {});
    ASSERT_TRUE(switcher.start({.remove = {"com_xy"}, .duration = 0.5}));
    (void)switcher.update(first);
    (void)switcher.update(0.1);
    EXPECT_TRUE(switcher.transition().is_going_on()) << first;
    const LevelTransition ended = switcher.update(0.7);
    EXPECT_FALSE(ended.is_going_on()) << first;
    EXPECT_FALSE(ended.after[kComXy]);
    EXPECT_TRUE(switcher.is_idle());
  }
}

TEST(LevelSwitcher, WithoutADurationItSwitchesAtOnce) {
  LevelSwitcher switcher(table_one(), {{.time = 0.0, .remove = {"com_xy"}, .duration = 0.0},
                                       {.time = 0.0, .remove = {"torso_yaw"}, .duration = 0.0}});
  const LevelTransition& transition = switcher.update(0.0);
  EXPECT_FALSE(transition.is_going_on());
  EXPECT_FALSE(transition.after[kComXy]);
  EXPECT_FALSE(transition.after[kTorsoYaw]);
}

TEST(LevelSwitcher, ExchangesLevelsInOneTransition) {
  LevelSwitcher switcher(table_one(), {{.time = 0.0, .remove = {"torso_yaw"}, .duration = 0.0}});
  (void)switcher.update(0.0);
  ASSERT_TRUE(switcher.start({.add = {"torso_yaw"}, .remove = {"torso_height"}}));
  const LevelTransition& transition = switcher.update(0.1);
  EXPECT_TRUE(transition.is_going_on());
  EXPECT_FALSE(transition.before[kTorsoYaw]);
  EXPECT_TRUE(transition.before[kTorsoHeight]);
  EXPECT_TRUE(transition.after[kTorsoYaw]);
  EXPECT_FALSE(transition.after[kTorsoHeight]);
}

TEST(LevelSwitcher, MakesOneTransitionAtATimeAndThoseOfTheScheduleWait) {
  LevelSwitcher switcher(table_one(), {{.time = 0.2, .remove = {"com_xy"}, .duration = 0.1}});
  ASSERT_TRUE(switcher.start({.remove = {"torso_yaw"}, .duration = 0.5}));
  EXPECT_FALSE(switcher.start({.remove = {"torso_height"}})) << "not begun, but asked for";
  (void)switcher.update(0.0);
  EXPECT_FALSE(switcher.start({.remove = {"torso_height"}}));
  EXPECT_TRUE(switcher.update(0.4).after[kComXy]);
  const LevelTransition& next = switcher.update(0.5);
  EXPECT_FALSE(next.before[kTorsoYaw]);
  EXPECT_FALSE(next.after[kComXy]);
  EXPECT_EQ(next.share, 0.0);
}

TEST(LevelSwitcher, SaysWhenASwitchThatWasAskedForBegins) {
  LevelSwitcher switcher(table_one(), {{.time = 0.0, .remove = {"com_xy"}, .duration = 0.1}});
  (void)switcher.update(0.0);
  EXPECT_FALSE(switcher.begun().begins) << "that of the schedule";
  (void)switcher.update(0.2);
  ASSERT_TRUE(switcher.start({.add = {"com_xy"}, .remove = {"torso_yaw"}, .duration = 0.25}));
  EXPECT_FALSE(switcher.begun().begins) << "only at the next update";
  (void)switcher.update(0.3);
  const LevelSwitchReport begun = switcher.begun();
  EXPECT_TRUE(begun.begins);
  EXPECT_EQ(begun.duration, 0.25);
  EXPECT_EQ(begun.change[kComXy], LevelChange::comes);
  EXPECT_EQ(begun.change[kTorsoYaw], LevelChange::goes);
  EXPECT_EQ(begun.change[kTorsoHeight], LevelChange::stays);
  (void)switcher.update(0.4);
  EXPECT_FALSE(switcher.begun().begins);
}

std::string complaint(const std::vector<LevelSwitch>& schedule) {
  return test::message_of([&] { const LevelSwitcher switcher(table_one(), schedule); });
}

TEST(LevelSwitcher, SwitchesThatMakeNoSenseAreErrors) {
  const auto says = [](const LevelSwitch& change, const char* what) {
    EXPECT_TRUE(holds(complaint({change}), what));
  };
  says({.add = {"com"}}, "unknown level \"com\"; the stack \"terrain_adaptation\" can switch: com");
  says({.remove = {"friction_cone"}}, "\"friction_cone\" keeps the physics and is always there");
  says({.remove = {"no_contact_motion"}}, "keeps the physics");
  says({.time = -1.0, .remove = {"com_xy"}}, "time of a level switch is -1");
  says({.remove = {"com_xy"}, .duration = -0.1}, "duration of a level switch is -0.1");
  says({.remove = {"com_xy"}, .duration = kNaN}, "duration of a level switch is nan");
  says({}, "adds and removes nothing");
  says({.add = {"com_xy"}, .remove = {"com_xy"}}, "added and removed at once");
  EXPECT_TRUE(holds(complaint({{.time = 1.0, .remove = {"com_xy"}, .duration = 0.5},
                               {.time = 1.4, .add = {"com_xy"}}}),
                    "at 1.4 s begins before the one above it has ended, at 1.5 s"));
}

/// Largest change of a torque from one tick to the next while a level goes [N·m], of a robot that
/// stays where it is.
double largest_step(const std::string& level, double duration) {
  ControllerOptions options = test::options_of();
  options.external_force.enabled = false;  // it would believe that someone holds the statue
  test::Statue statue(options);
  statue.state.q_WB = Quat(Eigen::AngleAxisd(0.05, Vec3(1.0, 1.0, 0.5).normalized()));
  statue.user.height = -0.05;
  statue.run(1200);  // until the plan rests
  JointVector before = statue.tick().torque;
  EXPECT_TRUE(statue.controller.switch_levels({.remove = {level}, .duration = duration}));
  double largest = 0.0;
  for (int tick = 0; tick < 250; ++tick) {
    const JointVector now = statue.tick().torque;
    EXPECT_EQ(statue.controller.record().command.mode, CommandMode::optimal);
    largest = std::max(largest, (now - before).cwiseAbs().maxCoeff());
    before = now;
  }
  return largest;
}

/// A statue never comes to where its COM is wanted, so this level pushes into its limits.
TEST(Controller, SwitchesALevelFarFromItsReferenceInEqualSharesOfTheWholeChange) {
  constexpr double kDuration = 0.5, kPeriod = 0.0025;
  const double at_once = largest_step("com_xy", 0.0);
  EXPECT_GT(at_once, 1.0) << "nothing to smooth";
  EXPECT_LE(largest_step("com_xy", kDuration), 1.05 * 1.5 * kPeriod / kDuration * at_once + 1e-3);
}

TEST(Controller, SwitchesLevelsWithoutAllocating) {
  test::Statue statue;
  statue.run(10);
  const LevelSwitch change{.remove = {"torso_yaw", "torso_height"}, .duration = 0.1};
  const test::MallocCounter counter;
  EXPECT_TRUE(statue.controller.switch_levels(change));
  statue.run(60);
  EXPECT_EQ(counter.count(), 0u);
  EXPECT_EQ(statue.controller.hierarchy().level(kTorsoHeight).num_rows(), 0);
  EXPECT_EQ(statue.controller.record().hierarchy.levels[kTorsoHeight].num_rows, 0);
}

TEST(Controller, SaysWhatHoldsALevelBackOnlyWhereItIsAskedAndAtAnOptimum) {
  test::Statue silent, explained;
  explained.controller.explain_levels(true);
  for (test::Statue* statue : {&silent, &explained})
    statue->state.q_WB = Quat(Eigen::AngleAxisd(0.05, Vec3::UnitX()));
  const auto expect_same_torques = [&] {
    EXPECT_EQ(silent.controller.record().command.torque,
              explained.controller.record().command.torque);
  };
  for (int tick = 0; tick < 100; ++tick) {
    const test::MallocCounter counter;
    (void)silent.tick();
    (void)explained.tick();
    EXPECT_EQ(counter.count(), 0u);
    expect_same_torques();
  }
  EXPECT_FALSE(silent.controller.record().hierarchy.blocking_is_known);
  EXPECT_EQ(silent.controller.record().hierarchy.num_blocking, 0);
  EXPECT_TRUE(explained.controller.record().hierarchy.blocking_is_known);
  EXPECT_GT(explained.controller.record().hierarchy.num_blocking, 0);
  for (test::Statue* statue : {&silent, &explained})
    EXPECT_TRUE(statue->controller.switch_levels({.remove = {"torso_yaw"}, .duration = 0.1}));
  for (int tick = 0; tick < 100; ++tick) {
    (void)silent.tick();
    (void)explained.tick();
    expect_same_torques();
    const HierarchyReport& report = explained.controller.record().hierarchy;
    EXPECT_EQ(report.level_switch.begins, tick == 0);
    EXPECT_EQ(report.blocking_is_known, report.transition_share >= 1.0) << tick;
  }
  EXPECT_EQ(explained.controller.record().hierarchy.transition_share, 1.0);
}

}  // namespace
}  // namespace surefoot::control
