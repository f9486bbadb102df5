#include "cli/replay_text.hpp"

#include "tests/replay/compared.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <string>

namespace surefoot::cli {
namespace {

using test::compared;
using test::holds;

TEST(ComparisonText, AMarkIsExplainedWhereThereIsOne) {
  replay::StackComparison result = compared();
  result.walk_end = {0.4, "its torso came to the ground"};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_TRUE(holds(text, "0.5000 s *"));
  EXPECT_TRUE(holds(text, "* From 0.4000 s on the run says nothing of its walk"));
}

TEST(ComparisonText, WhereNothingIsMarkedNoMarkIsExplained) {
  replay::StackComparison result = compared();
  result.walk_end = {0.75, "its torso came to the ground"};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_FALSE(holds(text, "*"));
  EXPECT_TRUE(holds(text, "\nFrom 0.7500 s on the run says nothing of its walk"));
}

TEST(ComparisonText, SaysWhereTheTorquesAreFarApart) {
  replay::StackComparison result = compared();
  result.header.robot.torque_limit = JointVector::Constant(kNumLegJoints, 40.0);
  EXPECT_FALSE(holds(comparison_text("run.mcap", result), "would soon have been another"));
  result.joints[5].rms = 10.0;
  EXPECT_TRUE(holds(comparison_text("run.mcap", result),
                    "Torques of joint5 differ by 25 % of its limit (rms)"));
}

TEST(ComparisonText, SaysOfWhichTicksTheTablesAreAndWhyTheOthersHaveNoAnswer) {
  replay::StackComparison result = compared();
  result.compared = 300;
  result.not_asked = {20, 0.9, ""};
  result.other_unanswered = {80, 0.125, "its solve was cut off in com_xy"};
  result.other_stopped = {1, 0.325, "too many ticks without a solution"};
  const std::string text = comparison_text("run.mcap", result);
  for (const char* part :
       {"Both answered 300 ticks of 400, from which the tables are made.\n",
        "\nNot asked at 20 ticks, first at 0.9000 s: the run planned nothing there",
        "\nNo answer of the other hierarchy at 80 ticks, first at 0.1250 s: its solve was cut off "
        "in com_xy.\n",
        "would have been stopped for safety at 1 tick, first at 0.3250 s: too many ticks without a "
        "solution. The ticks behind are asked all the same.\n"})
    EXPECT_TRUE(holds(text, part));
}

TEST(ComparisonText, WhereAllIsAnsweredAndTheRunIsReproducedNothingElseIsSaid) {
  replay::StackComparison result = compared();
  result.compared = result.ticks;
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_TRUE(holds(text, "\nBoth answered every tick.\n"));
  for (const char* part : {"Not asked", "No answer", "stopped", "This build"})
    EXPECT_FALSE(holds(text, part));
}

TEST(ComparisonText, SaysWhereThisBuildIsAnotherThanTheRuns) {
  replay::StackComparison result = compared();
  result.not_reproduced = {7, 0.5, ""};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_TRUE(holds(text, "other torques for the run itself at 7 ticks, first at 0.5000 s"));
}

TEST(ComparisonText, ATorqueBelowRoundingIsNothingAndHasNoTimeOfItsLargest) {
  replay::StackComparison result = compared();
  for (replay::JointComparison& joint : result.joints) joint = {2e-15, -7.66e-15, 0.25};
  const std::string text = comparison_text("run.mcap", result);
  EXPECT_FALSE(holds(text, "e-15"));
  EXPECT_FALSE(holds(text, "0.2500 s"));
}

}  // namespace
}  // namespace surefoot::cli
