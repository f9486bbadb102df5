#include "cli/progress.hpp"
#include "surefoot/base/error.hpp"
#include "tests/cli/solve_command_run.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <regex>
#include <string>

namespace surefoot::cli {
namespace {

using test::CommandRun;
using test::holds;
using test::Json;
using test::kCertified;
using test::kExplainedAsJson;

TEST(SolveCommand, AnAnswerThatWasCutOffIsNotBlamedOnLengthsOfRows) {
  const std::string line =
      R"({"levels":[{"D":[[-2e6,1e6],[0,1]],"f":[3e6,-0.8],"A":[[1,-2]],"b":[-0.7]}]})";
  const CommandRun whole(line, kCertified);
  EXPECT_EQ(whole.exit_code, 0) << whole.err.str();
  const CommandRun run(line, {.file = "", .certify = true, .budget = 1.0});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(
      holds(run.err.str(), ":1: not proven, cut off in level 1 of 1 at its budget; only levels"));
  EXPECT_FALSE(holds(run.err.str(), "in length"));
}

TEST(SolveCommand, SaysWhatABudgetHasToBe) {
  const std::string line =
      R"({"levels":[{"A":[[1,1]],"b":[2]},{"D":[[1,0],[0,1]],"f":[-3,2]},{"A":[[1,0]],"b":[9]}]})";
  const double flops = CommandRun(line).results.at(0).at("flops");
  EXPECT_GT(flops, 0.0);
  const CommandRun enough(line, {.file = "", .budget = flops});
  EXPECT_FALSE(enough.results.at(0).contains("status"));
  const CommandRun explained(line, kExplainedAsJson);
  EXPECT_EQ(explained.results.at(0).at("flops"), flops);
  EXPECT_FALSE(CommandRun(line, {.file = "", .method = "cascade"}).results.at(0).contains("flops"));
}

TEST(SolveCommand, OfALineThatTheSolversOwnCapHasEndedABudgetIsNotBlamed) {
  const std::string line =
      R"({"levels":[{"D":[[-1,1,-2],[1,2,0],[1,2,0],[1,-1,-2],[1,0,1],[1,2,2],[-2,1,-1],[-1,1,)"
      R"(-1]],"lower":[0,0,null,null,null,null,0,0],"f":[null,0,0,0,0,0,0,null]},{"D":[],"lowe)"
      R"(r":[],"f":[]},{"D":[[1,0,-2],[0,0,-2],[-2,1,-1],[-2,-2,0],[-2,0,2],[-2,-2,2],[2,-2,0])"
      R"(,[1,2,0]],"lower":[null,null,0,0,0,0,0,null],"f":[0,4.024812557322575,0,0,0,0,null,-0)"
      R"(.7729654952265927]},{"D":[[1,0,0],[0,1,0],[0,0,1]],"lower":[-3.481651663534138,-0.572)"
      R"(7512207958192,4.2712791873188],"f":[-3.481651663534138,-0.5727512207958192,4.27127918)"
      R"(73188]}]})";
  const CommandRun run(line, {.file = "", .budget = 1e9});
  ASSERT_EQ(run.results.at(0).at("status"), "iteration_cap");
  EXPECT_EQ(run.results.at(0).at("cut_off_by"), "cap");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.err.str(), "at the solver's own cap"));
  const double spent = run.results.at(0).at("flops");
  const CommandRun less(line, {.file = "", .budget = 0.5 * spent});
  EXPECT_EQ(less.results.at(0).at("cut_off_by"), "budget");
  EXPECT_EQ(less.exit_code, 0);
  EXPECT_FALSE(CommandRun(line).results.at(0).contains("status")) << "the cascade solves it";
}

TEST(SolveCommand, EndsALineAtItsBudgetWithTheLevelsThatAreFinished) {
  const std::string line = R"({"levels":[{"A":[[1,1]],"b":[2]},{"D":[[1,0]],"f":[-3]}]})";
  const CommandRun all(line, {.file = "", .budget = 1e6});
  EXPECT_FALSE(all.results.at(0).contains("status"));
  const CommandRun none(line, {.file = "", .budget = 0.0});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_EQ(none.results.at(0).at("status"), "iteration_cap");
  EXPECT_EQ(none.results.at(0).at("cut_off_by"), "budget");
  EXPECT_NEAR(none.results.at(0)["levels"][0]["residual"], 0.0, 1e-12);
  EXPECT_GT(none.results.at(0)["levels"][1]["residual"].get<double>(), 1.0);
}

/// The level in the middle is the one that no budget at all cuts off.
const std::string kCutInTheMiddle =
    R"({"levels":[{"A":[[1,1]],"b":[2]},{"name":"limit","D":[[1,0]],"f":[-3]},)"
    R"({"name":"wish","A":[[0,1]],"b":[1]}]})";

TEST(SolveCommand, OfLevelsThatWereNotFinishedOnlyWhatIsKnownIsTold) {
  const CommandRun run(kCutInTheMiddle, {.file = "", .certify = true, .budget = 0.0});
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(holds(run.err.str(), ":1: not proven, cut off in level 2 of 3"));
  const Json& levels = run.results.at(0).at("levels");
  EXPECT_FALSE(levels[0].contains("status"));
  EXPECT_TRUE(levels[0].contains("certificate"));
  EXPECT_EQ(levels[1].at("status"), "cut off");
  EXPECT_GT(levels[1].at("residual").get<double>(), 1.0);
  EXPECT_FALSE(levels[1].contains("certificate"));
  EXPECT_EQ(levels[2], Json({{"status", "not reached"}}));
  EXPECT_FALSE(CommandRun(kCutInTheMiddle).results.at(0).contains("cut_off_by"));
}

TEST(SolveCommand, ExplainsNothingOfLevelsThatWereNotFinished) {
  const SolveArguments text{.file = "", .certify = true, .explain = true, .budget = 0.0};
  SolveArguments json = text;
  json.json = true;
  const CommandRun table(kCutInTheMiddle, text), line(kCutInTheMiddle, json);
  const std::string out = table.out.str();
  EXPECT_TRUE(holds(out, "status: iteration_cap, at its budget in level 2"));
  EXPECT_TRUE(holds(out, "so far: the search ended in this level, at its budget"));
  EXPECT_FALSE(holds(out, "held back"));
  EXPECT_TRUE(std::regex_search(out, std::regex("\n2 limit +cut off +4 ?[^\n]*–\n"))) << out;
  EXPECT_TRUE(std::regex_search(out, std::regex("\n3 wish +not reached +– +1 +– +– +– +– +– +–\n")))
      << out;
  const Json& levels = line.results.at(0).at("levels");
  EXPECT_TRUE(levels[0].contains("blocked_by"));
  EXPECT_EQ(levels[1].at("missed").size(), 1u);
  for (const char* key : {"blocked_by", "certificate", "freedom_left"})
    EXPECT_FALSE(levels[1].contains(key)) << key;
  EXPECT_EQ(levels[2], Json({{"name", "wish"}, {"status", "not reached"}, {"rows", 1}}));
}

TEST(SolveCommand, ABudgetThatSufficesForAllLevelsSaysOptimal) {
  for (const char* line : {R"({"levels":[{"A":[[1,1]],"b":[2]},{"A":[[1,0]],"b":[3]}]})",
                           R"({"levels":[{"A":[[1,0],[0,1]],"b":[1,2]},{"D":[[1,1]],"f":[1]}]})"}) {
    const CommandRun run(line, {.file = "", .certify = true, .budget = 0.0});
    EXPECT_FALSE(run.results.at(0).contains("status")) << line;
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    EXPECT_EQ(run.err.str(), "");
  }
}

TEST(SolveCommand, AMethodThatThereIsNotOrHasNoBudgetIsAnError) {
  EXPECT_THROW(CommandRun("", {.file = "", .method = "simplex"}), Error);
  EXPECT_THROW(CommandRun("", {.file = "", .method = "cascade", .budget = 1.0}), Error);
  EXPECT_THROW(CommandRun("", {.file = "", .budget = -1.0}), Error);
}

TEST(SolveCommand, EndsALineAtItsBudgetOfMicroseconds) {
  const std::string line = R"({"levels":[{"D":[[1,0]],"f":[-1]},{"D":[[0,1]],"f":[-2]}]})";
  const CommandRun run(line, {.file = "", .budget_us = 0.0});
  EXPECT_EQ(run.exit_code, 0) << run.err.str();
  EXPECT_EQ(run.results[0]["status"], "iteration_cap");
  const CommandRun whole(line, {.file = "", .budget_us = 1e9});
  EXPECT_FALSE(whole.results[0].contains("status"));
  EXPECT_NEAR(whole.results[0]["x"][1], -2.0, 1e-12);
  for (const SolveArguments& wrong :
       {SolveArguments{.file = "", .budget_us = -1.0},
        SolveArguments{.file = "", .method = "cascade", .budget_us = 1.0}})
    EXPECT_THROW(CommandRun(line, wrong), Error);
}

/// The first line that goes to stderr while `Something` lives; waits for it.
template <typename Something>
std::string first_line_while(Something make) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const int before = dup(STDERR_FILENO);
  dup2(ends[1], STDERR_FILENO);
  std::string line;
  {
    const auto something = make();
    for (char letter = 0; letter != '\n' && read(ends[0], &letter, 1) == 1;) line += letter;
  }
  dup2(before, STDERR_FILENO);
  for (const int end : {before, ends[0], ends[1]}) close(end);
  return line;
}

TEST(SolveCommand, WhatTakesLongSaysThatItGoesOn) {
  const auto line =
      first_line_while([] { return Waiting("solving a.jsonl:1", std::chrono::milliseconds(1)); });
  EXPECT_TRUE(std::regex_match(line, std::regex("solving a\\.jsonl:1: [0-9]+ s\n"))) << line;
}

}  // namespace
}  // namespace surefoot::cli
