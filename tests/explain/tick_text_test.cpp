#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/explain/gave_way.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/solver/solution.hpp"
#include "tests/support/messages.hpp"
#include "tests/support/source_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace surefoot::explain {
namespace {

using test::holds;

TEST(TickText, AForceThatIsRoundedAwayHasNoSign) {
  TickExplanation explanation;
  for (FootPlan& foot : explanation.tick.plan.feet) foot.phase = LegPhase::stance;
  explanation.forces.normal.fill(-0.04);
  explanation.truth.emplace();
  for (simulation::TrueContact& contact : explanation.truth->feet) {
    contact.touching = true;
    contact.force = Vec3(0.0, 0.0, -0.04);
  }
  const std::string text = explanation.text();
  EXPECT_TRUE(holds(text, "0.0 N"));
  EXPECT_FALSE(holds(text, "-0.0 N"));
}

TEST(TickText, AFrameThatIsToldToReachHasItsName) {
  TickExplanation explanation;
  explanation.tick.user.reach = {.position = Vec3(0.4, 0.0, 0.3), .frame = 1};
  explanation.tick.plan.frames.add({.frame = 1, .p_XF = Vec3(0.4, 0.0, 0.2)});
  EXPECT_TRUE(holds(explanation.text(), "frame 1 to x 0.400")) << "an older log has no names";
  explanation.header.robot.frame_names = {"base", "gripper"};
  EXPECT_TRUE(holds(explanation.text(),
                    "gripper to x 0.400, y 0.000, z 0.300 m in B; the reference is 10.0 cm from "
                    "there"));
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
  tick.hierarchy.status = static_cast<std::int32_t>(solver::SolveStatus::invalid_input);
  tick.hierarchy.num_levels = 1;
  tick.command.mode = CommandMode::damping;
  tick.command.cause = StopCause::tilt;
  explanation.forces = commanded_forces(std::nullopt, tick, 1.0);
  return explanation;
}

TEST(TickText, ATickThatSolvedNothingShowsNeitherForcesNorLevelsNorLimits) {
  const std::string text = unsolved().text();
  EXPECT_TRUE(holds(text, "No hierarchy was solved: "));
  EXPECT_TRUE(holds(text, "because the torso tilted too far"));
  EXPECT_TRUE(holds(text, "command     damping, as the torso tilted too far; largest torque"));
  for (const char* absent : {"17522", "com_xy", "No limit acts", "stance", "nan"})
    EXPECT_FALSE(holds(text, absent));
}

template <typename Value>
Value value_of(const auto& names, const nlohmann::json& name) {
  return static_cast<Value>(std::ranges::find(names, name.get<std::string>()) - names.begin());
}

TEST(TickText, OfASolutionThatCommandsNothingTheSameIsSaidAsOnThePage) {
  const auto rows =
      nlohmann::json::parse(std::ifstream(test::source_file("tests/support/unused_words.json")));
  EXPECT_GE(rows.size(), 4u);
  for (const auto& row : rows) {
    TickExplanation explanation = unsolved();
    TickRecord& tick = explanation.tick;
    if (row[0].get<bool>()) tick.hierarchy.status = 0;
    tick.command.mode = value_of<CommandMode>(logged::kModeNames, row[1]);
    tick.command.cause = value_of<StopCause>(logged::kCauseNames, row[2]);
    tick.command.fault = value_of<SampleFault>(logged::kFaultNames, row[3]);
    EXPECT_EQ(explanation.sentence(), row[4]);
  }
}

/// A tick at which two levels gave way to the same rows, none of which costs anything alone.
TickExplanation pushed_over() {
  TickExplanation explanation;
  logging::LogHeader& header = explanation.header;
  header.level_names = {"friction_cone", "com_xy", "torso_yaw"};
  header.level_units = {"N", "m/s²", "rad/s²"};
  header.robot.torque_limit.setConstant(40.0);
  explanation.order = {0, 1, 2};
  TickRecord& tick = explanation.tick;
  tick.command.mode = CommandMode::optimal;
  for (FootPlan& foot : tick.plan.feet) {
    foot.phase = LegPhase::stance;
    foot.force_max = 400.0;
  }
  HierarchyReport& report = tick.hierarchy;
  report.num_levels = 3;
  for (LevelReport& level : report.levels) level.num_rows = 2;
  report.blocking_is_known = true;
  for (const std::int16_t level : std::array<std::int16_t, 2>{1, 2}) {
    report.levels[static_cast<std::size_t>(level)].residual = 30.0 + level;
    for (const std::int32_t id : {0, 1}) {
      BlockingRow& row = report.blocking[static_cast<std::size_t>(report.num_blocking++)];
      row.level = level;
      row.by_level = 0;
      row.id = id;
      row.cost = 0.0;
    }
  }
  explanation.row_names = {{{0, 0}, "LF +x"}, {{0, 1}, "RH −y"}};
  explanation.forces.normal = {100.0, -16392.6, 399.0, 0.0};
  return explanation;
}

TEST(TickText, LevelsThatGaveWayToTheSameRowsAreToldOnceWithThem) {
  EXPECT_EQ(pushed_over().sentence(),
            "com_xy gave way by 31 m/s² to friction_cone LF +x and RH −y; torso_yaw gave way by 32 "
            "rad/s² to the same; rows without a number cost nothing alone.");
}

TEST(TickText, OfRowsThatAreWorthTellingTheLimitsAreToldFirst) {
  TickExplanation explanation = pushed_over();
  explanation.exact = ExactCosts{{1,
                                  {{"swing_foot", "LF x", 31.002, {}, false},
                                   {"swing_foot", "LF y", kNaN, {}, false},
                                   {"torque_limits", "LF KFE", 3.0, {}, true},
                                   {"friction_cone", "RH −y", 12.0, {}, true},
                                   {"limb_extension_limits", "LF extension", 31.001, {}, true}}},
                                 {2, {}}};
  explanation.tick.hierarchy.levels[2].residual = 0.0;
  EXPECT_EQ(explanation.sentence(),
            "com_xy gave way by 31 m/s² to limb_extension_limits LF extension (31 m/s²), "
            "friction_cone RH −y (12 m/s²), swing_foot LF x (31 m/s²) and 2 more.");
  std::vector<CostlyRow> many{{"swing_foot", "LF x", 31.0, {}, false}};
  for (const char* row : {"A", "B", "C", "D", "E"})
    many.push_back({"torque_limits", row, 5.0, {}, true});
  explanation.exact = ExactCosts{{1, many}, {2, {}}};
  EXPECT_EQ(explanation.sentence(),
            "com_xy gave way by 31 m/s² to torque_limits A (5 m/s²), B (5 m/s²), C (5 m/s²), "
            "swing_foot LF x (31 m/s²) and 2 more.")
      << "the dearest is told";
  explanation.exact.reset();
  HierarchyReport& report = explanation.tick.hierarchy;
  report.active[0] = {.level = 0, .state = 1, .id = 1, .by = 0.0};
  report.num_active = 1;
  EXPECT_EQ(gave_way(explanation).front().to.front().row, "RH −y") << "of estimates, too";
}

TEST(TickText, AForceBeyondItsLimitsIsToldAsAWish) {
  TickExplanation explanation = pushed_over();
  const std::string text = explanation.text();
  EXPECT_TRUE(holds(text, "-16392.6 N *"));
  EXPECT_FALSE(holds(text, "399.0 N *"));
  EXPECT_TRUE(holds(text, "* the solution's wish"));
  EXPECT_TRUE(holds(text, "optimal, but for contact forces that no ground gives"));
  explanation.forces.normal[1] = 100.0;
  EXPECT_FALSE(holds(explanation.text(), "no ground gives"));
}

TEST(TickText, WhereTheCommandIsNotTheSolutionsNothingIsToldAsItsWish) {
  for (const CommandMode mode : {CommandMode::degraded, CommandMode::hold, CommandMode::sit}) {
    TickExplanation explanation = pushed_over();
    explanation.tick.command.mode = mode;
    const std::string text = explanation.text();
    EXPECT_FALSE(holds(text, "wish"));
    EXPECT_FALSE(holds(text, "no ground gives"));
    EXPECT_FALSE(holds(text, "N *"));
  }
}

TEST(TickText, WhatStoppedTheRobotStaysTheReasonAndWhatIsWrongNowIsToldApart) {
  TickExplanation stopped = unsolved();
  stopped.tick.command.cause = StopCause::encoders;
  stopped.tick.command.fault = SampleFault::jump;
  stopped.tick.health.encoders = {.fault = SampleFault::out_of_range, .age = 0.15, .joint = 4};
  const std::string text = stopped.text();
  EXPECT_TRUE(holds(text, "because encoders of several joints changed too fast"));
  EXPECT_TRUE(holds(text, "sensors now: encoder RF_HFE left the range (last good 0.1500 s ago)"));
}

TEST(TickText, TheJsonOfATickThatSolvedNothingHasNoNumbersOfAnother) {
  const auto json = explanation_json(unsolved());
  EXPECT_EQ(text_of(json), unsolved().json());
  EXPECT_EQ(json.at("solved"), false);
  EXPECT_TRUE(json.at("model").is_null() && json.at("plan").is_null());
  EXPECT_TRUE(json.at("levels").empty() && json.at("gave_way").empty());
  EXPECT_TRUE(json.at("feet").at("RH").at("normal_force").is_null());
  EXPECT_TRUE(json.at("feet").at("RH").at("phase").is_null());
}

TEST(TickText, AtTheFirstTickOfAStopWhatWasSolvedIsNotToldAsWhatCommands) {
  for (const CommandMode mode : {CommandMode::sit, CommandMode::damping}) {
    TickExplanation explanation = pushed_over();
    TickRecord& tick = explanation.tick;
    tick.model.force.fill(Vec3(0.0, 0.0, -17522.0));
    tick.hierarchy.active[0] = {0, 3, 1};
    tick.hierarchy.num_active = 1;
    tick.command.mode = mode;
    tick.command.cause = StopCause::imu;
    tick.command.fault = SampleFault::silent;
    explanation.forces = commanded_forces(std::nullopt, tick, 1.0);
    const std::string text = explanation.text();
    EXPECT_TRUE(holds(text, "The controller stopped, and what was solved was not used: "));
    EXPECT_TRUE(holds(text, ", because IMU stopped."));
    for (const char* absent : {"17522", "com_xy", "gave way", "Limits that act", "stance"})
      EXPECT_FALSE(holds(text, absent));
    const auto json = explanation_json(explanation);
    EXPECT_EQ(json.at("solved"), false);
    EXPECT_TRUE(json.at("levels").empty() && json.at("gave_way").empty());
    EXPECT_TRUE(json.at("limits").is_null() && json.at("plan").is_null());
    EXPECT_TRUE(json.at("feet").at("RH").at("normal_force").is_null());
  }
}

TEST(TickText, WhatPushesTheRobotIsToldInTextAndJson) {
  TickExplanation explanation = unsolved();
  explanation.truth.emplace();
  EXPECT_FALSE(holds(explanation.text(), "pushed by"));
  EXPECT_TRUE(explanation_json(explanation).at("pushed_by").empty());
  explanation.bodies = {"world", "base"};
  explanation.applied = {{.body = 1, .force = Vec3(0, 50, 0)}};
  explanation.events = {{0.5, "pushed by 50 N", "", "outside"}};
  const std::string text = explanation.text();
  EXPECT_TRUE(holds(text,
                    "pushed by   50 N, 90° from ahead to the left, on the base (truth: the "
                    "controller is not told)"));
  const auto json = explanation_json(explanation);
  EXPECT_EQ(json.at("pushed_by").at(0).at("body"), "base");
  EXPECT_EQ(json.at("pushed_by").at(0).at("size"), 50.0);
  EXPECT_EQ(json.at("events").at(0).at("by"), "outside");
}

TEST(TickText, WhatTheRobotIsFoundToCarryIsToldWithItsPlace) {
  TickExplanation explanation;
  explanation.header.robot.mass = 30.0;
  const auto says = [&](double mass, const Vec3& at) {
    explanation.tick.model.load = {.mass = mass, .first_moment = mass * at};
    return explanation.text();
  };
  const Vec3 at(0.05, -0.02, 0.2);
  EXPECT_TRUE(
      holds(says(6.9, at), "weighs      6.9 kg more than described, at x 0.05, y -0.02, z 0.20 m"));
  EXPECT_TRUE(holds(says(-2.0, at), "2.0 kg less than described\n"));
  for (const double nothing : {0.0, -0.2, kNaN})
    EXPECT_FALSE(holds(says(nothing, at), "weighs")) << nothing;
  explanation.header.robot.mass = 3.0;
  EXPECT_TRUE(holds(says(0.2, at), "0.2 kg more than described, at x 0.05"));
  EXPECT_FALSE(holds(says(0.04, at), "weighs"));
}

TEST(TickText, ASolveThatWasCutOffIsSaidToBe) {
  TickExplanation explanation;
  explanation.header.level_names = {"dynamics", "com_xy"};
  explanation.order = {0, 1};
  HierarchyReport& report = explanation.tick.hierarchy;
  report.num_levels = 2;
  report.status = static_cast<std::int32_t>(solver::SolveStatus::iteration_cap);
  report.failed_level = 1;
  EXPECT_EQ(explanation.sentence(),
            "Every level above com_xy got what it asked for. The solver was cut off in com_xy: of "
            "it and the levels below it nothing is known.");
  report.failed_level = 0;
  EXPECT_EQ(explanation.sentence(),
            "The solver was cut off in dynamics: of it and the levels below it nothing is known.");
  report.failed_level = 2;
  EXPECT_EQ(explanation.sentence(), "Every level got what it asked for.")
      << "only x is not the shortest";
  report.status = static_cast<std::int32_t>(solver::SolveStatus::optimal);
  report.failed_level = -1;
  EXPECT_EQ(explanation.sentence(), "Every level got what it asked for.");
}

/// A tick whose solve was cut off in its second level by priority, the last of the header.
TickExplanation cut_off() {
  TickExplanation explanation = pushed_over();
  HierarchyReport& report = explanation.tick.hierarchy;
  explanation.order = {0, 2, 1};
  report.status = static_cast<std::int32_t>(solver::SolveStatus::iteration_cap);
  report.failed_level = 2;
  for (const std::int16_t level : explanation.order) {
    LevelReport& one = report.levels[static_cast<std::size_t>(level)];
    one.num_rows = 71 + level;
    ActiveRow& row = report.active[static_cast<std::size_t>(report.num_active++)];
    row = {.level = level, .state = 1, .id = 8};
    explanation.row_names[{level, 8}] = "row_of_" + std::to_string(level);
  }
  return explanation;
}

TEST(TickText, OfASolveThatWasCutOffNothingIsToldOfTheLevelItWasInAndThoseBelow) {
  EXPECT_TRUE(gave_way(cut_off()).empty());
  const std::string text = cut_off().text();
  for (const char* told : {"The solver was cut off in torso_yaw", "71", "friction_cone row_of_0"})
    EXPECT_TRUE(holds(text, told));
  for (const auto& [level, status] :
       {std::pair("2 torso_yaw", "cut off"), std::pair("3 com_xy", "not reached")}) {
    const std::size_t begin = text.find(level);
    ASSERT_NE(begin, std::string::npos) << text;
    EXPECT_NE(text.substr(begin, text.find('\n', begin) - begin).find(status), std::string::npos)
        << text;
  }
  for (const char* absent : {"gave way", "32 rad", "72", "73", "row_of_1", "row_of_2"})
    EXPECT_FALSE(holds(text, absent));
  const auto json = explanation_json(cut_off());
  EXPECT_TRUE(json.at("gave_way").empty());
  EXPECT_EQ(json.at("limits").size(), 1u);
  EXPECT_EQ(json.at("levels").at(0).at("rows"), 71);
  EXPECT_EQ(json.at("levels").at(1).at("status"), "cut off");
  EXPECT_EQ(json.at("levels").at(2).at("status"), "not reached");
  for (const std::size_t place : {1u, 2u})
    for (const char* member : {"residual", "rows", "at_bound", "freedom_left", "iterations"})
      EXPECT_TRUE(json.at("levels").at(place).at(member).is_null()) << member;
}

TEST(TickText, OfLimitsOfLevelsThatWereNotSolvedNothingIsSaid) {
  TickExplanation explanation = cut_off();
  EXPECT_TRUE(holds(explanation.text(), "Limits that act in the levels that were solved:"));
  explanation.tick.hierarchy.num_active = 0;
  EXPECT_TRUE(holds(explanation.text(), "In the levels that were solved no limit acts."));
  EXPECT_TRUE(explanation_json(explanation).at("limits").empty());
  EXPECT_FALSE(explanation_json(explanation).at("limits").is_null());
  explanation.tick.hierarchy.failed_level = explanation.order[0];
  EXPECT_FALSE(holds(explanation.text(), "imit acts"));
  EXPECT_TRUE(explanation_json(explanation).at("limits").is_null());
  EXPECT_TRUE(explanation_json(unsolved()).at("limits").is_null());
}

TEST(TickText, OfASolveThatWasCutOffOnlyLevelsAboveHaveAResidual) {
  HierarchyReport report;
  report.num_levels = 3;
  report.status = static_cast<std::int32_t>(solver::SolveStatus::iteration_cap);
  for (const std::int32_t failed : {0, 1, 2, 3}) {
    report.failed_level = failed;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_known = static_cast<std::int32_t>(k) < failed;
      EXPECT_EQ(std::isnan(logging::computed_residual(report, k)), !is_known)
          << k << " of " << failed;
    }
  }
  report.status = static_cast<std::int32_t>(solver::SolveStatus::invalid_input);
  EXPECT_TRUE(std::isnan(logging::computed_residual(report, 0)));
}

TEST(TickText, NumbersJustBelowAHundredHaveAllTheirDigits) {
  TickExplanation explanation = pushed_over();
  explanation.tick.hierarchy.levels[1].residual = 99.7;
  EXPECT_TRUE(holds(explanation.sentence(), "com_xy gave way by 100 m/s²"));
}

TEST(TickText, AResidualHasTheSameDigitsInTheSentenceAndInTheTable) {
  TickExplanation explanation = pushed_over();
  explanation.tick.hierarchy.levels[1].residual = 1064.3;
  EXPECT_TRUE(holds(explanation.sentence(), "gave way by 1064 m/s²"));
  EXPECT_TRUE(holds(explanation.text(), "2 com_xy          missed   1064 m/s²"));
}

TEST(TickText, RowsSayByHowMuchTheyAreBeyondABoundOrWereMissed) {
  TickExplanation explanation = pushed_over();
  HierarchyReport& report = explanation.tick.hierarchy;
  report.num_active = 3;
  report.active[0] = {.level = 0, .state = 1, .id = 0};
  report.active[1] = {.level = 0, .state = -3, .id = 1, .by = -12.5};
  report.active[2] = {.level = 0, .state = 3, .id = 1, .by = kNaN};  // of a log before 2.9
  report.num_missed = 2;
  report.missed[0] = {.level = 1, .id = 0, .by = -30.5};
  report.missed[1] = {.level = 2, .id = 0, .by = 0.001};  // nothing that one sees
  explanation.row_names[{1, 0}] = "x";
  const std::string text = explanation.text();
  EXPECT_TRUE(holds(text,
                    "  friction_cone LF +x, at its upper bound\n"
                    "  friction_cone RH −y, beyond its lower bound by 12.5 N\n"
                    "  friction_cone RH −y, beyond its upper bound\n"
                    "Rows that were missed:\n"
                    "  com_xy x, by -30.5 m/s²\n"));
  EXPECT_FALSE(holds(text, "0.001"));
  const auto json = explanation_json(explanation);
  EXPECT_EQ(json.at("limits").at(1).at("by"), -12.5);
  EXPECT_TRUE(json.at("limits").at(2).at("by").is_null());
  EXPECT_EQ(json.at("missed").at(0).at("row"), "x");
  EXPECT_EQ(json.at("missed").at(0).at("by"), -30.5);
  EXPECT_EQ(json.at("levels").at(0).at("status"), "met");
  EXPECT_EQ(json.at("levels").at(1).at("status"), "missed");
}

}  // namespace
}  // namespace surefoot::explain
