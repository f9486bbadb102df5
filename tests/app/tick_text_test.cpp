#include "app/tick_text.hpp"

#include "surefoot/solver/solution.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot {
namespace {

TEST(TickText, AForceThatIsRoundedAwayHasNoSign) {
  TickExplanation explanation;
  for (FootPlan& foot : explanation.tick.plan.feet) foot.phase = LegPhase::stance;
  explanation.forces.normal.fill(-0.04);
  explanation.truth.emplace();
  for (TrueContact& contact : explanation.truth->feet) {
    contact.touching = true;
    contact.force = Vec3(0.0, 0.0, -0.04);
  }
  const std::string text = tick_text("run.mcap", explanation);
  EXPECT_NE(text.find("0.0 N"), std::string::npos) << text;
  EXPECT_EQ(text.find("-0.0 N"), std::string::npos) << text;
}

/// Of a tick that solved nothing, whose record still has what an older controller left in it.
TickExplanation unsolved() {
  TickExplanation explanation;
  explanation.header.level_names = {"com_xy"};
  explanation.order = {0};
  explanation.header.robot.torque_limit.setConstant(40.0);
  TickRecord& tick = explanation.tick;
  tick.reading.time = 1.0;
  for (FootPlan& foot : tick.plan.feet) foot.phase = LegPhase::stance;
  for (Vec3& force : tick.model.force) force = Vec3(0.0, 0.0, -17522.0);
  tick.hierarchy.status = static_cast<std::int32_t>(SolveStatus::invalid_input);
  tick.hierarchy.num_levels = 1;
  tick.command.mode = CommandMode::damping;
  tick.command.cause = StopCause::tilt;
  explanation.forces = commanded_forces(std::nullopt, tick);
  return explanation;
}

TEST(TickText, ATickThatSolvedNothingShowsNeitherForcesNorLevelsNorLimits) {
  const std::string text = tick_text("run.mcap", unsolved());
  EXPECT_NE(text.find("No hierarchy was solved at this tick"), std::string::npos) << text;
  EXPECT_NE(text.find("because the torso tilted too far"), std::string::npos) << text;
  for (const char* absent : {"17522", "com_xy", "No limit acts", "stance", "nan"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent << " in\n" << text;
}

TEST(TickText, TheJsonOfATickThatSolvedNothingHasNoNumbersOfAnother) {
  const auto json = tick_json("run.mcap", unsolved());
  EXPECT_EQ(json.at("solved"), false);
  EXPECT_TRUE(json.at("model").is_null() && json.at("plan").is_null());
  EXPECT_TRUE(json.at("levels").empty() && json.at("gave_way").empty());
  EXPECT_TRUE(json.at("feet").at("RH").at("normal_force").is_null());
  EXPECT_TRUE(json.at("feet").at("RH").at("phase").is_null());
}

TEST(TickText, WhatPushesTheRobotIsToldInTextAndJson) {
  TickExplanation explanation = unsolved();
  explanation.truth.emplace();
  EXPECT_EQ(tick_text("run.mcap", explanation).find("pushed by"), std::string::npos);
  EXPECT_TRUE(tick_json("run.mcap", explanation).at("pushed_by").empty());
  explanation.bodies = {"world", "base"};
  explanation.applied = {{.body = 1, .force = Vec3(0, 50, 0)}};
  explanation.events = {{0.5, "pushed by 50 N", "", "outside"}};
  const std::string text = tick_text("run.mcap", explanation);
  EXPECT_NE(text.find("pushed by 50 N, 90° from ahead to the left, on the base (truth: the "
                      "controller is not told)"),
            std::string::npos)
      << text;
  const auto json = tick_json("run.mcap", explanation);
  EXPECT_EQ(json.at("pushed_by").at(0).at("body"), "base");
  EXPECT_EQ(json.at("pushed_by").at(0).at("size"), 50.0);
  EXPECT_EQ(json.at("events").at(0).at("by"), "outside");
}

TEST(TickText, ASolveThatWasCutOffIsSaidToBe) {
  TickExplanation explanation;
  explanation.header.level_names = {"dynamics", "com_xy"};
  explanation.order = {0, 1};
  HierarchyReport& report = explanation.tick.hierarchy;
  report.num_levels = 2;
  report.status = static_cast<std::int32_t>(SolveStatus::iteration_cap);
  report.failed_level = 1;
  EXPECT_NE(gave_way_sentence(explanation).find("cut off in com_xy"), std::string::npos);
  report.status = static_cast<std::int32_t>(SolveStatus::optimal);
  EXPECT_EQ(gave_way_sentence(explanation).find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace surefoot
