#include "app/replay_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot {
namespace {

/// Its largest residual is at 0.5 s, that of its torques at 0.25 s.
StackComparison compared() {
  StackComparison result;
  result.ticks = 400;
  result.last_time = 0.9975;
  for (std::size_t i = 0; i < result.joints.size(); ++i) {
    result.header.robot.joint_names[i] = "joint" + std::to_string(i);
    result.joints[i] = {.rms = 1.0, .largest = -2.0, .time = 0.25};
  }
  result.levels = {{.name = "com_xy",
                    .unit = "m/s²",
                    .in_log = true,
                    .in_other = true,
                    .logged_rms = 0.1,
                    .logged_max = 0.3,
                    .logged_time = 0.5}};
  return result;
}

TEST(ComparisonText, AMarkIsExplainedWhereThereIsOne) {
  StackComparison result = compared();
  result.walk_end = {0.4, "its torso came to the ground"};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_NE(text.find("0.5000 s *"), std::string::npos) << text;
  EXPECT_NE(text.find("* From 0.4000 s on the run says nothing of its walk"), std::string::npos)
      << text;
}

TEST(ComparisonText, WhereNothingIsMarkedNoMarkIsExplained) {
  StackComparison result = compared();
  result.walk_end = {0.75, "its torso came to the ground"};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_EQ(text.find('*'), std::string::npos) << text;
  EXPECT_NE(text.find("\nFrom 0.7500 s on the run says nothing of its walk"), std::string::npos)
      << text;
}

TEST(ComparisonJson, WhatWasNeverLargerThanNothingHasNoTimeOfItsLargest) {
  StackComparison result = compared();
  result.joints[3] = {};
  const auto json = comparison_json("run.mcap", result);
  EXPECT_EQ(json.at("levels")[0].at("logged").at("time"), 0.5);
  EXPECT_TRUE(json.at("levels")[0].at("other").at("time").is_null());
  EXPECT_EQ(json.at("torque_difference").at("joint2").at("time"), 0.25);
  EXPECT_TRUE(json.at("torque_difference").at("joint3").at("time").is_null());
}

}  // namespace
}  // namespace surefoot
