#include "surefoot/replay/replay_json.hpp"

#include "tests/replay/compared.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace surefoot::replay {
namespace {

using test::compared;
using test::holds;

nlohmann::json parsed(const StackComparison& result) {
  return nlohmann::json::parse(json_of("run.mcap", result));
}

TEST(ComparisonJson, SaysOfWhichTicksItIsAndWhyTheOthersHaveNoAnswer) {
  StackComparison result = compared();
  result.compared = 300;
  result.not_asked = {20, 0.9, ""};
  result.other_unanswered = {80, 0.125, "its solve was cut off in com_xy"};
  result.other_stopped = {1, 0.325, "too many ticks without a solution"};
  const auto json = parsed(result);
  EXPECT_EQ(json.at("compared"), 300);
  EXPECT_EQ(json.at("unanswered").at("other").at("ticks"), 80);
  EXPECT_EQ(json.at("unanswered").at("other").at("why"), "its solve was cut off in com_xy");
  EXPECT_EQ(json.at("other_stopped").at("first"), 0.325);
  EXPECT_EQ(json.at("not_asked").at("ticks"), 20);
}

TEST(ComparisonJson, TimesAreToTheNanosecond) {
  StackComparison result = compared();
  result.last_time = 12.405000000000001;
  result.joints[0].time = 12.405000000000001;
  const std::string text = json_of("run.mcap", result);
  EXPECT_FALSE(holds(text, "12.405000"));
  EXPECT_TRUE(holds(text, "\"last_time\":12.405,"));
}

TEST(ComparisonJson, WhatWasNeverLargerThanNothingHasNoTimeOfItsLargest) {
  StackComparison result = compared();
  result.joints[3] = {};
  const auto json = parsed(result);
  EXPECT_EQ(json.at("levels")[0].at("logged").at("time"), 0.5);
  EXPECT_TRUE(json.at("levels")[0].at("other").at("time").is_null());
  EXPECT_EQ(json.at("torque_difference").at("joint2").at("time"), 0.25);
  EXPECT_TRUE(json.at("torque_difference").at("joint3").at("time").is_null());
}

}  // namespace
}  // namespace surefoot::replay
