#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/gaits/gait.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace surefoot::config {
namespace {

using test::holds;
using test::message_of;

Scenario load(const std::string& name, const std::vector<std::string>& changes = {}) {
  return load_scenario({.name_or_path = name, .seed = 0, .assignments = changes});
}

std::string told(const std::string& change) {
  return message_of([&] { (void)load("walk_flat", {"gait=trot", change}); });
}

TEST(GaitFile, lies_between_its_scenario_and_that_ones_base) {
  const gaits::PlannerOptions walk = load("walk_flat").controller.planner,
                              trot = load("walk_flat", {"gait=trot"}).controller.planner,
                              changed =
                                  load("trot", {"planner.force.ramp_up=0.02"}).controller.planner;
  EXPECT_FALSE(walk.rhythm.enabled);
  EXPECT_TRUE(trot.rhythm.enabled);
  EXPECT_EQ(trot.stance.half_length, walk.stance.half_length);
  EXPECT_LT(load("trot").controller.planner.force.ramp_up, walk.force.ramp_up);
  EXPECT_EQ(changed.force.ramp_up, 0.02);
}

TEST(GaitFile, is_replaced_by_an_assignment_and_none_is_the_crawl) {
  EXPECT_FALSE(load("trot", {"gait=none"}).controller.planner.rhythm.enabled);
}

TEST(GaitFile, is_fitted_to_the_robot) {
  const Scenario small = load("trot", {"robot=go1"});
  EXPECT_NEAR(small.controller.planner.rhythm.period,
              small.robot.scale.time() * load("trot").controller.planner.rhythm.period, 1e-6);
}

TEST(GaitFile, all_of_the_data_folder_can_be_trotted_with) {
  for (const std::string& name : list_data("gaits")) {
    const std::string robot = name == "tripod" ? "robot=hexapod" : "robot=anymal_b";
    const gaits::RhythmOptions rhythm =
        load("trot", {robot, "gait=" + name}).controller.planner.rhythm;
    EXPECT_EQ(rhythm.enabled, name != "stand" && name != "static_crawl") << name;
    EXPECT_FALSE(describe_data("gaits", name).empty()) << name;
  }
}

TEST(GaitFile, that_makes_no_sense_is_told_with_what_would) {
  EXPECT_TRUE(holds(told("gait=trott"), "trot"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0"), "above 0 and below 1"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty={LH: 1}"), "LH is 1"));
  EXPECT_TRUE(holds(told("planner.rhythm.period=0.05"), "force.ramp_up"));
  EXPECT_TRUE(holds(told("planner.rhythm.offset.MF=0.3"), "LF"));
  EXPECT_TRUE(holds(told("planner.rhythm.offset.LF=1.3"), "0 to 1"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0.4"), "with a rhythm.duty of 0.4 it leaves"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0.4"), "a gait with rhythm.flies may do so"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0.98"), "leaves it 0.01 s to swing"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0.98"), "takes at least 0.085 s"));
  EXPECT_TRUE(holds(told("planner.rhythm.period=100"), "let LF swing for 50 s; valid is a swing"));
  EXPECT_TRUE(holds(told("planner.rhythm.speed_max=0"), "above 0"));
}

TEST(GaitFile, notes_a_command_that_its_gait_is_too_slow_for_but_not_where_the_speed_chooses) {
  const std::string fast = "user=[{time: 0.5, walk: true, velocity: [1.4, 0]}]";
  const std::vector<std::string> notes = load("trot", {fast}).notes;
  EXPECT_TRUE(std::ranges::any_of(notes, [](const std::string& note) {
    return holds(note, "feet of 1.4 m/s at 0.5 s; the gait's speed_max is 1.2 m/s");
  }));
  EXPECT_TRUE(load("trot").notes.empty());
  EXPECT_TRUE(load("trot", {fast, "gait=auto", "gaits=[crawl, trot, flying_trot]"}).notes.empty());
}

TEST(GaitFile, of_other_legs_is_refused_with_their_names) {
  const std::string message =
      message_of([] { (void)load("walk_flat", {"robot=hexapod", "gait=trot"}); });
  EXPECT_TRUE(holds(message, "gaits/trot.yaml"));
  EXPECT_TRUE(
      holds(message, "is given for the legs LF RH RF LH, but hexapod has LF RF LM RM LH RH"));
  const std::string six = message_of([] { (void)load("trot", {"gait=tripod"}); });
  EXPECT_TRUE(holds(six, "gaits/tripod.yaml"));
  EXPECT_TRUE(holds(six, "but anymal_b has LF RF LH RH; valid is a gait that has an offset"));
}

TEST(GaitFile, of_a_robot_that_only_stands_is_refused) {
  EXPECT_TRUE(holds(message_of([] { (void)load("flat_feet", {"gait=trot"}); }),
                    "g1 has flat feet and only stands; it has no gait"));
}

TEST(GaitFile, with_a_name_that_is_missing_is_refused) {
  EXPECT_TRUE(holds(message_of([] { (void)load("trot", {"gait="}); }),
                    "--set gait=: a name is missing; gait=none takes"));
}

/// A gait of the user's that is never made.
gaits::OwnGaits own_gaits() {
  gaits::OwnGaits own;
  own.add("march", [](const gaits::PlannerOptions&, double, const Scale&) {
    return std::unique_ptr<gaits::Gait>();
  });
  return own;
}

TEST(OwnGaits, are_named_by_scenarios_and_commands_besides_the_librarys) {
  const auto load_own = [](const std::vector<std::string>& changes) {
    return load_scenario(
        {.name_or_path = "trot", .seed = 0, .assignments = changes, .own_gaits = own_gaits()});
  };
  const Scenario alone = load_own({"gait=march"});
  ASSERT_EQ(alone.controller.gaits.size(), 1u);
  EXPECT_EQ(alone.controller.first_gait, 0);
  EXPECT_NE(alone.controller.gaits[0].make, nullptr);
  const Scenario beside = load_own({"user=[{time: 1, walk: true, gait: march}]"});
  ASSERT_EQ(beside.controller.gaits.size(), 2u);
  EXPECT_EQ(beside.user(30.0).gait, 1);
  EXPECT_EQ(beside.controller.gaits[0].make, nullptr) << "trot";
  EXPECT_NE(beside.controller.gaits[1].make, nullptr);
  EXPECT_TRUE(holds(message_of([&] { (void)load_own({"gait=marsh"}); }), "march"));
}

TEST(LoadedGaits, are_those_of_the_list_the_scenario_and_its_commands) {
  const Scenario one = load("trot"), some = load("trot", {"gaits=[crawl, pace]"}),
                 commanded = load("walk_flat", {"user=[{time: 1, walk: true, gait: trot}]"});
  EXPECT_TRUE(one.controller.gaits.empty());
  const Scenario listed = load("trot", {"gaits=[trot]"});
  ASSERT_EQ(listed.controller.gaits.size(), 1u);
  EXPECT_EQ(listed.controller.first_gait, 0);
  ASSERT_EQ(some.controller.gaits.size(), 3u);
  EXPECT_EQ(some.controller.gaits[2].name, "trot");
  EXPECT_EQ(some.controller.first_gait, 2);
  EXPECT_EQ(some.user(30.0).gait, UserCommand::kOwnGait);
  ASSERT_EQ(commanded.controller.gaits.size(), 1u);
  EXPECT_EQ(commanded.controller.first_gait, UserCommand::kOwnGait);
  EXPECT_EQ(commanded.user(0.5).gait, UserCommand::kOwnGait);
  EXPECT_EQ(commanded.user(2.0).gait, 0);
  EXPECT_TRUE(commanded.controller.gaits[0].options.rhythm.enabled);
  EXPECT_FALSE(commanded.controller.planner.rhythm.enabled);
}

TEST(LoadedGaits, lie_where_the_gait_lies_and_take_assignments_and_draws) {
  const Scenario scenario =
      load_scenario({.name_or_path = "trot",
                     .seed = 3,
                     .assignments = {"gaits=[crawl, trot]", "planner.swing.apex=0.07",
                                     "randomise.planner.push.slow_shift="
                                     "[0.2, 0.3]"}});
  const control::ControllerOptions& controller = scenario.controller;
  for (const gaits::NamedGait& gait : controller.gaits) {
    EXPECT_EQ(gait.options.swing.apex, 0.07) << gait.name;
    EXPECT_EQ(gait.options.push.slow_shift, controller.planner.push.slow_shift) << gait.name;
  }
  EXPECT_GT(controller.planner.push.slow_shift, 0.19);
  EXPECT_EQ(controller.gaits[1].options.rhythm.period, controller.planner.rhythm.period);
  EXPECT_GT(controller.gaits[0].options.rhythm.period, controller.planner.rhythm.period);
}

TEST(LoadedGaits, of_auto_are_those_from_slow_to_fast) {
  const Scenario scenario = load("trot", {"gait=auto"});
  ASSERT_EQ(scenario.controller.gaits.size(), 3u);
  EXPECT_EQ(scenario.controller.gaits[0].name, "crawl");
  EXPECT_EQ(scenario.controller.gaits[2].name, "flying_trot");
  EXPECT_EQ(scenario.controller.first_gait, UserCommand::kAutoGait);
}

TEST(LoadedGaits, that_are_not_there_are_told) {
  EXPECT_TRUE(holds(told("gaits=[trot, gallop]"), "gallop"));
  EXPECT_TRUE(holds(told("gaits=trot"), "list of names"));
  EXPECT_TRUE(holds(told("user=[{time: 1, gait: trott}]"), "trot"));
}

}  // namespace
}  // namespace surefoot::config
