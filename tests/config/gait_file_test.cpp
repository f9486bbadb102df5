#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "tests/logging/temporary_folder.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

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
    EXPECT_TRUE(load("trot", {"gait=" + name}).controller.planner.rhythm.enabled) << name;
    EXPECT_FALSE(describe_data("gaits", name).empty()) << name;
  }
}

TEST(GaitFile, that_makes_no_sense_is_told_with_what_would) {
  EXPECT_TRUE(holds(told("gait=trott"), "trot"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty=0"), "above 0 and below 1"));
  EXPECT_TRUE(holds(told("planner.rhythm.duty={LH: 1}"), "LH is 1"));
  EXPECT_TRUE(holds(told("planner.rhythm.period=0.05"), "force.ramp_up"));
  EXPECT_TRUE(holds(told("planner.rhythm.offset.MF=0.3"), "LF"));
}

}  // namespace
}  // namespace surefoot::config
