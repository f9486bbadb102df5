#include "surefoot/base/error.hpp"
#include "surefoot/solver/sweep.hpp"
#include "tests/cli/solve_command_run.hpp"
#include "tests/support/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::cli {
namespace {

using test::CommandRun;
using test::holds;
using test::Json;
using test::kCertified;
using test::kExplained;
using test::kExplainedAsJson;
using test::message_of;

TEST(SolveCommand, WritesOneLineForEach) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1,0]],\"b\":[1]},{\"A\":[[1,1]],\"b\":[4]}]}\n"
      "\n"
      "{\"levels\":[{\"D\":[[1]],\"f\":[1]},{\"A\":[[1]],\"b\":[3]}]}");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.err.str(), "");
  ASSERT_EQ(run.results.size(), 2u);
  EXPECT_NEAR(run.results[0]["x"][0], 1.0, 1e-12);
  EXPECT_NEAR(run.results[0]["x"][1], 3.0, 1e-12);
  EXPECT_NEAR(run.results[1]["x"][0], 1.0, 1e-12);
  EXPECT_NEAR(run.results[1]["levels"][0]["residual"], 0.0, 1e-12);
  EXPECT_NEAR(run.results[1]["levels"][1]["residual"], 2.0, 1e-12);
}

TEST(SolveCommand, SaysWhereAnAnswerIsBorderline) {
  const std::string clear = R"({"levels":[{"A":[[1,1],[1,2]],"b":[0,1]}]})";
  const std::string weak = R"({"levels":[{"A":[[1,1],[1,1.00000000005]],"b":[0,1]}]})";
  EXPECT_FALSE(CommandRun(clear).results[0].contains("borderline"));
  EXPECT_EQ(CommandRun(weak).results[0]["borderline"], true);
  EXPECT_EQ(CommandRun(weak, kExplainedAsJson).results[0]["borderline"], true);
  const CommandRun text(weak, kExplained);
  EXPECT_TRUE(holds(text.out.str(), ", borderline: "));
}

TEST(SolveCommand, SaysWhichInstructionsTheSolverUses) {
  const std::string line = R"({"levels":[{"A":[[1]],"b":[1]}]})",
                    name = solver::fastest_kernels().name;
  EXPECT_EQ(CommandRun(line).results[0]["instructions"], name);
  EXPECT_EQ(CommandRun(line, kExplainedAsJson).results[0]["instructions"], name);
  const CommandRun text(line, kExplained);
  EXPECT_TRUE(holds(text.out.str(), ":1, " + name + " instructions\n"));
  const CommandRun cascade(line, {.file = "", .method = "cascade"});
  EXPECT_FALSE(cascade.results[0].contains("instructions"));
}

TEST(SolveCommand, TheResidualIsThatOfEqualitiesAndViolatedInequalitiesTogether) {
  const CommandRun run(
      R"({"levels":[{"A":[[1]],"b":[0]},{"A":[[1]],"b":[3],"D":[[1],[-1]],"f":[5,-4]}]})");
  ASSERT_EQ(run.results.size(), 1u);
  EXPECT_NEAR(run.results[0]["levels"][1]["residual"], std::sqrt(9.0 + 16.0), 1e-12);
}

TEST(SolveCommand, UnknownsMayHaveVeryDifferentUnits) {
  const std::string line =
      R"({"levels":[{"D":[[-0.00048828125,0,-0.00390625,-131072],[0.00048828125,0,0.00390625,131072]],)"
      R"("lower":[null,4],"f":[6,4]},{"A":[[0.000244140625,-128,-0.005859375,-262144],)"
      R"([0,384,0.001953125,-393216]],"b":[1,-2]},)"
      R"({"A":[[-0.000244140625,-256,0.00390625,-131072]],"b":[1]}]})";
  for (const char* method : {"lexicographic", "cascade"}) {
    const CommandRun run(line, {.file = "", .certify = true, .method = method});
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    for (const Json& level : run.results[0]["levels"])
      EXPECT_LE(level["residual"].get<double>(), 1e-9) << method;
  }
}

TEST(SolveCommand, LevelsFromOneOnCanBeSolvedAsOneWeightedLevel) {
  const std::string line =
      R"({"levels":[{"D":[[1]],"f":[5]},{"name":"near","A":[[1]],"b":[0]},{"A":[[1]],"b":[4]}]})";
  const auto x = [&](int from, const std::vector<double>& weights) {
    const CommandRun run(line,
                         {.file = "", .certify = true, .weighted_from = from, .weights = weights});
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    EXPECT_EQ(run.results[0]["levels"].size(), static_cast<std::size_t>(from));
    const Json& strict = run.results[0]["strict_residuals"];
    const double at = run.results[0]["x"][0];
    EXPECT_NEAR(strict[1], std::abs(at), 1e-12);
    EXPECT_NEAR(strict[2], std::abs(at - 4.0), 1e-12);
    return at;
  };
  EXPECT_NEAR(x(3, {}), 0.0, 1e-12) << "the last alone: strict";
  EXPECT_NEAR(x(2, {}), 2.0, 1e-12);
  EXPECT_NEAR(x(2, {1.0, 3.0}), 3.6, 1e-12);
  EXPECT_FALSE(CommandRun(line).results[0].contains("strict_residuals"));
  const CommandRun text(line, {.file = "", .explain = true, .weighted_from = 2});
  EXPECT_TRUE(holds(text.out.str(), "near, A 1 is 2 too high"));
}

TEST(SolveCommand, WhatXIsToBeCloseToStaysTheLastLevelBelowTheWeightedOne) {
  const std::string levels =
      R"({"levels":[{"A":[[1,0]],"b":[1]},{"A":[[1,0],[1,1]],"b":[3,7]},{"A":[[1,1]],"b":[7]}])";
  const SolveArguments weighted{.file = "", .certify = true, .weighted_from = 2};
  const CommandRun without(levels + "}", weighted), with(levels + R"(,"x_ref":[0,0]})", weighted);
  EXPECT_EQ(with.exit_code, 0) << with.err.str();
  for (const std::size_t i : {0u, 1u})
    EXPECT_NEAR(with.results[0]["x"][i], without.results[0]["x"][i], 1e-9);
  EXPECT_EQ(with.results[0]["levels"].size(), 3u);
  EXPECT_EQ(with.results[0]["strict_residuals"].size(), 4u);
  EXPECT_NEAR(with.results[0]["strict_residuals"][2], 0.0, 1e-9);
  const CommandRun more(levels + R"(,"x_ref":[0,0]})",
                        {.file = "", .weighted_from = 2, .weights = {1.0, 1.0, 1.0}});
  EXPECT_TRUE(holds(more.err.str(), "with 3 weights; expected at most 2"));
  const CommandRun below(levels + R"(,"x_ref":[0,0]})", {.file = "", .weighted_from = 4});
  EXPECT_TRUE(holds(below.err.str(), "expected 1 to 3"));
}

TEST(SolveCommand, WeightedFromALevelThatIsNotThereIsWrongInput) {
  const std::string line = R"({"levels":[{"A":[[1]],"b":[1]},{"A":[[1]],"b":[2]}]})";
  const CommandRun run(line, {.file = "", .weighted_from = 3});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(holds(run.err.str(), ":1: --weighted is 3; expected 1 to 2"));
  const CommandRun more(line, {.file = "", .weighted_from = 2, .weights = {1.0, 2.0}});
  EXPECT_TRUE(holds(more.err.str(), "--weighted is 2 with 2 weights; expected at most 1"));
  EXPECT_THROW(CommandRun(line, {.file = "", .weights = {1.0}}), Error);
  for (const int none : {0, -1})
    EXPECT_THROW(CommandRun(line, {.file = "", .weighted_from = none}), Error);
  EXPECT_THROW(CommandRun(line, {.file = "", .weighted_from = 1, .weights = {0.0}}), Error);
}

TEST(SolveCommand, ABadLineIsNamedAndTheOthersAreSolved) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1]],\"b\":[1]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[1,2]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[3]}]}\n");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.results.size(), 2u);
  EXPECT_EQ(run.err.str().find(run.file.string() + ":2: level 1: b has 2 elements"), 0u)
      << run.err.str();
}

TEST(SolveCommand, NumbersBeyondTheRangeOfTheSolverAreNamed) {
  const CommandRun run(R"({"levels":[{"A":[[1e200]],"b":[1]}]})");
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_TRUE(run.results.empty());
  EXPECT_TRUE(holds(run.err.str(), ":1: level 1: A: row 1: element 1 is 1e+200, too large"));
}

TEST(SolveCommand, AnswersBeyondTheRangeOfDoublesAreNamed) {
  const std::string overflow =
      R"({"levels":[{"A":[[1e-90,0]],"b":[1e100]},{"A":[[0,1e-90]],"b":[1e100]}]})";
  for (const char* method : {"lexicographic", "cascade"}) {
    const CommandRun run(overflow + "\n" + R"({"levels":[{"A":[[1]],"b":[3]}]})",
                         {.file = "", .certify = true, .method = method});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.results.size(), 1u);
    EXPECT_TRUE(holds(run.err.str(), ":1: the answer is beyond the range of doubles"));
  }
}

TEST(SolveCommand, TheReferenceGivesTheSameAnswer) {
  const std::string line =
      R"({"levels":[{"D":[[1,0],[1,1]],"f":[1,1]},{"A":[[1,2]],"b":[4]},{"A":[[1,0],[0,1]],"b":[3,0]}]})";
  const CommandRun ours(line), cascade(line, {.file = "", .method = "cascade"});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(ours.results.at(0)["x"][i], cascade.results.at(0)["x"][i], 1e-12);
  }
}

TEST(SolveCommand, ABadLineOfAnyKindLeavesTheOthersSolved) {
  const std::string good = R"({"levels":[{"A":[[1]],"b":[3]}]})";
  const std::vector<std::pair<std::string, std::string>> bad{
      {R"({"levels":[{"D":[[1]],"lowr":[0],"f":[1]}]})", "did you mean \"lower\"?"},
      {R"({"levels":[{"A":[[1]],"A":[[2]],"b":[1]}]})", "the key \"A\" is given twice"},
      {R"({"levels":[{"name":1,"A":[[1]],"b":[1]}]})", "name is 1; expected a text"},
      {R"({"levels":[{"A":[[1],[1]],"b":[1,2],"A_ids":[3,3]}]})", "another row of the level has"},
      {R"({"levels":[{"A":[[1e-300]],"b":[1]}]})", "level 1: A: row 1: has nothing larger than"},
      {R"({"levels":[{"D":[[1]]}]})", "level 1: D has 1 row and no f"}};
  for (const auto& [line, message] : bad) {
    const CommandRun run(good + "\n" + line + "\n" + good + "\n");
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.results.size(), 2u);
    EXPECT_EQ(std::ranges::count(run.err.str(), '\n'), 1);
    EXPECT_EQ(run.err.str().find(run.file.string() + ":2: "), 0u) << run.err.str();
    EXPECT_TRUE(holds(run.err.str(), message));
  }
}

TEST(SolveCommand, AFileWithoutALineIsAnError) {
  for (const char* text : {"", "\n \n"}) {
    EXPECT_TRUE(holds(message_of([&] { CommandRun run(text); }),
                      "is empty; expected a file with one JSON object"));
  }
}

TEST(SolveCommand, NumbersAtTheEndsOfWhatIsAcceptedAreSolved) {
  const std::string lines =
      R"({"levels":[{"A":[[1e100]],"b":[-1e100]}]})"
      "\n"
      R"({"levels":[{"A":[[1e-100]],"b":[3e-100]}]})"
      "\n"
      R"({"levels":[{"D":[[1]],"lower":[-1e100],"f":[1e100]},{"A":[[1]],"b":[2]}]})";
  for (const char* method : {"lexicographic", "cascade"}) {
    const CommandRun run(lines, {.file = "", .certify = true, .method = method});
    EXPECT_EQ(run.exit_code, 0) << run.err.str();
    ASSERT_EQ(run.results.size(), 3u);
    EXPECT_NEAR(run.results[0]["x"][0], -1.0, 1e-12);
    EXPECT_NEAR(run.results[1]["x"][0], 3.0, 1e-12);
    EXPECT_NEAR(run.results[2]["x"][0], 2.0, 1e-12);
  }
}

TEST(SolveCommand, AFileThatCannotBeReadIsAnError) {
  std::ostringstream out, err;
  EXPECT_THROW((void)run_solve({.file = "/no/such/file.jsonl"}, out, err), FileError);
  EXPECT_THROW((void)run_solve({.file = testing::TempDir()}, out, err), FileError);
  EXPECT_EQ(out.str(), "");
}

/// Nothing that a terminal would obey, but for the ends of lines.
bool is_harmless(const std::string& text) {
  const auto is_control = [](char c) {
    const auto code = static_cast<unsigned char>(c);
    return (code < 0x20 && c != '\n') || code == 0x7f;
  };
  return std::ranges::none_of(text, is_control) && text.find("\xc2\x9b") == std::string::npos;
}

TEST(SolveCommand, ControlCharactersInNamesAreWrittenOutWhereverTheyAreTold) {
  const std::string odd = "\\u001b[31m\u007f\u009b1m\\ttab\\n";
  const std::string named = R"("name":")" + odd + R"(","unit":")" + odd + R"(")";
  const std::string line = "{\"levels\":[{" + named + R"(,"D":[[1],[0]],"f":[1,0],"D_names":[")" +
                           odd + R"(","b"]},{)" + named + R"(,"A":[[1]],"b":[3],"A_names":[")" +
                           odd + "\"]},{" + named + "}]}";
  for (const bool is_text : {false, true}) {
    for (const bool is_explained : {false, true}) {
      const CommandRun run(
          line, {.file = "", .certify = true, .explain = is_explained, .json = !is_text});
      EXPECT_EQ(run.exit_code, 0) << run.err.str();
      EXPECT_TRUE(is_harmless(run.out.str())) << run.out.str();
      EXPECT_TRUE(is_harmless(run.err.str())) << run.err.str();
      EXPECT_TRUE(
          holds(run.err.str(), "level 3 (\\u001b[31m\\u007f\\u009b1m\\u0009tab\\u000a) has"));
    }
  }
  const CommandRun json(line, kExplainedAsJson);
  EXPECT_EQ(json.results.at(0)["levels"][0]["name"],
            "\x1b[31m\x7f\xc2\x9b"
            "1m\ttab\n");
  const CommandRun text(line, kExplained);
  EXPECT_TRUE(holds(text.out.str(), "2 \\u001b[31m\\u007f\\u009b1m"));
}

TEST(SolveCommand, ControlCharactersInWhatIsWrongAreWrittenOut) {
  for (const std::string& line : std::vector<std::string>{
           R"({"levels":[{"\u001b[31m":1,"A":[[1]],"b":[1]}]})",
           "{\"levels\":[{\"\x7f\":1,\"A\":[[1]],\"b\":[1]}]}",
           R"({"levels":[{"\u001b":1,"\u001b":2}]})",
           "{\"levels\":[{\"A\":[[1]],\"b\":[\"\xc2\x9b\"]}]}", "{\"levels\":[{\"A\":\x7f}]}",
           R"({"levels":[{"name":"\u001b[31m","A":[["\u001b"]],"b":[1]}]})"}) {
    const CommandRun run(line);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_TRUE(is_harmless(run.err.str())) << run.err.str();
    EXPECT_TRUE(holds(run.err.str(), "\\u00"));
  }
}

TEST(SolveCommand, ALevelWithoutRowsIsNamedWithItsLineAndAllLinesAreSolved) {
  const CommandRun run(
      "{\"levels\":[{\"A\":[[1]],\"b\":[1]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[2]},{\"name\":\"swing\"},{\"D\":[],\"f\":[]}]}\n"
      "{\"levels\":[{\"A\":[[1]],\"b\":[3]}]}\n");
  EXPECT_EQ(run.exit_code, 0);
  ASSERT_EQ(run.results.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(run.results[i]["x"][0], 1.0 + static_cast<double>(i), 1e-12);
  const std::string place = run.file.string() + ":2: note: ";
  EXPECT_EQ(run.err.str(), place + "level 2 (swing) has no rows, so it asks for nothing\n" + place +
                               "level 3 has no rows, so it asks for nothing\n");
  EXPECT_FALSE(run.results[0].contains("notes"));
  EXPECT_EQ(run.results[1].at("notes").size(), 2u);
  EXPECT_EQ(run.results[1].at("notes").at(0),
            "level 2 (swing) has no rows, so it asks for nothing");
}

TEST(SolveCommand, OfManyLevelsWithoutRowsOnlyTheFirstAreToldOutsideOfTheResults) {
  std::string text;
  for (int i = 0; i < 15; ++i) text += "{\"levels\":[{\"A\":[[1]],\"b\":[1]},{}]}\n";
  const CommandRun run(text);
  EXPECT_EQ(std::ranges::count(run.err.str(), '\n'), 11) << run.err.str();
  EXPECT_TRUE(holds(run.err.str(), "5 more levels without rows"));
  ASSERT_EQ(run.results.size(), 15u);
  for (const Json& line : run.results) EXPECT_EQ(line.at("notes").size(), 1u);
}

TEST(SolveCommand, WeightsDampingAndAReferenceAreThoseOfTheLine) {
  const CommandRun run(
      R"({"levels":[{"A":[[1,0],[1,0]],"b":[0,4],"A_weights":[1,3],"damping":2}],"x_ref":[1,5]})",
      kCertified);
  EXPECT_EQ(run.exit_code, 0) << run.err.str();
  ASSERT_EQ(run.results.size(), 1u);
  // x₁² + (3 x₁ − 12)² + 4 (x₁ − 1)² is least at 40 / 14.
  const double x = 40.0 / 14.0;
  EXPECT_NEAR(run.results[0]["x"][0], x, 1e-12);
  EXPECT_NEAR(run.results[0]["x"][1], 5.0, 1e-12);
  const Json& levels = run.results[0]["levels"];
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_NEAR(levels[0]["residual"],
              std::sqrt(x * x + std::pow(3 * x - 12, 2) + 4 * std::pow(x - 1, 2)), 1e-12);
  EXPECT_NEAR(levels[1]["residual"], x - 1.0, 1e-12);
}

}  // namespace
}  // namespace surefoot::cli
